"""Ways to compute that the plot shows, each with a short name."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from occ_model.results.accuracy import CLOSED_FORM, AccuracyPoint

_POINT_SPACING = 4  # of the samplings, every fourth one is a point; the curve joins them all


@dataclass(frozen=True, slots=True)
class Way:
    point: AccuracyPoint
    name: str


def ways_shown(points: Iterable[AccuracyPoint]) -> list[Way]:
    """Choose the points to show, the one of the present setting first.

    Of the ladder of effects only the ends are points: the table of effects shows its steps.
    """
    by_part: dict[str, list[AccuracyPoint]] = {}
    for point in points:
        by_part.setdefault(point.part, []).append(point)
    return [
        *_pictures(by_part.get("effects", [])),
        *_named(by_part.get("path", [])),  # its picture is the present one
        *(Way(point, point.name) for point in by_part.get("draft", [])),
        *_samplings(by_part.get("integration", [])),
        *_named(by_part.get("noise", [])),
    ]


def _pictures(points: Sequence[AccuracyPoint]) -> list[Way]:
    ladder = [point for point in points if not point.current]
    current = next((point for point in points if point.current), None)
    if not ladder:
        return []
    ends = {"": ladder[0], "+": ladder[-1]} if len(ladder) > 1 else {"": ladder[0]}
    words = {"": "picture, no effects", "+": "picture, all effects"}
    if current is None:  # the ladder is not complete yet
        return [Way(end, words[key] if key == "" else end.name) for key, end in ends.items()]
    same = next(
        (key for key, end in ends.items() if set(end.effects) == set(current.effects)), None
    )
    now = "now: picture" if same is None else f"now: {words[same]}"
    return [Way(current, now), *(Way(end, words[key]) for key, end in ends.items() if key != same)]


def _samplings(points: Sequence[AccuracyPoint]) -> list[Way]:
    samplings = [point for point in points if point.name != CLOSED_FORM]
    ways = [
        Way(point, point.name if place in (0, len(samplings) - 1) else point.name.split()[0])
        for place, point in enumerate(samplings)
        if place % _POINT_SPACING == 0
    ]
    ways.reverse()  # the most exact first
    return [*(Way(p, "closed form") for p in points if p.name == CLOSED_FORM), *ways]


def _named(points: Iterable[AccuracyPoint]) -> list[Way]:
    words = {
        "profile path": "profile only",
        "reused plane": "noise reused",
        "drawn for each pixel": "noise drawn",
    }
    return [Way(point, words[point.name]) for point in points if point.name in words]
