"""Points of the plot of error over time, each with a short name."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from occ_model.results.accuracy import CLOSED_FORM, AccuracyPoint

_POINT_SPACING = 4  # every fourth sampling is a point; the curve joins them all


@dataclass(frozen=True, slots=True)
class NamedPoint:
    point: AccuracyPoint
    name: str


def choose_points(points: Iterable[AccuracyPoint]) -> list[NamedPoint]:
    """Choose the points to show, the one of the present setting first.

    Of the sets of effects, only the smallest and the largest are points; the table shows all.
    """
    by_part: dict[str, list[AccuracyPoint]] = {}
    for point in points:
        by_part.setdefault(point.part, []).append(point)
    return [
        *_name_pictures(by_part.get("effects", [])),
        *_name_others(by_part.get("path", [])),  # its picture is the present one
        *(NamedPoint(point, point.name) for point in by_part.get("draft", [])),
        *_name_samplings(by_part.get("integration", [])),
    ]


def _name_pictures(points: Sequence[AccuracyPoint]) -> list[NamedPoint]:
    measured = [point for point in points if not point.current]
    current = next((point for point in points if point.current), None)
    if not measured:
        return []
    no_effects = NamedPoint(measured[0], "picture, no effects")
    last = measured[1:][-1:]  # empty if only one is measured
    if current is None:  # not all are measured yet
        return [no_effects, *(NamedPoint(point, point.name) for point in last)]
    ends = [no_effects, *(NamedPoint(point, "picture, all effects") for point in last)]
    effects = set(current.effects)
    same = next((end for end in ends if set(end.point.effects) == effects), None)
    name = "now: picture" if same is None else f"now: {same.name}"
    return [NamedPoint(current, name), *(end for end in ends if end is not same)]


def _name_samplings(points: Sequence[AccuracyPoint]) -> list[NamedPoint]:
    samplings = [point for point in points if point.name != CLOSED_FORM]
    named = [
        NamedPoint(point, point.name if place in (0, len(samplings) - 1) else point.name.split()[0])
        for place, point in enumerate(samplings)
        if place % _POINT_SPACING == 0
    ]
    named.reverse()  # the most exact first
    return [*(NamedPoint(p, "closed form") for p in points if p.name == CLOSED_FORM), *named]


def _name_others(points: Iterable[AccuracyPoint]) -> list[NamedPoint]:
    names = {"profile path": "profile only"}
    return [NamedPoint(point, names[point.name]) for point in points if point.name in names]
