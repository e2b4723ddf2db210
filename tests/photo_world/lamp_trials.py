"""What is said of single lamps whose truth is known: verdicts, and errors in stated errors."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from simulated_photos import photo_of

import occ_model as occ
from occ_model.results.match import ESTIMATES
from photo_world.lamp_views import LampView, lamp_view

FREQUENCY = 1000.0
WRONG = 0.03  # relative error of a period from which it is wrong
KNOWN = ("duty known", "exposure noted", "neither")
_NOTE_ERROR = 0.1
_MISREAD = 6.0  # stated errors of an exposure from where it is another reading's
_ALIKE = "these make the same stripes"
_VERDICTS = ("sure", "doubtful", "refused")


@dataclass(frozen=True)
class LampTrial:
    """One picture, matched; ``off`` and ``stated`` are relative for the period."""

    seed: int
    verdict: str
    shape_verdict: str = "refused"  # on duty and exposure
    is_misread: bool = False  # the exposure is sure, and that of another reading
    off: dict[str, float] = field(default_factory=dict)
    stated: dict[str, float] = field(default_factory=dict)
    classes: dict[str, str] = field(default_factory=dict)
    says: tuple[str, ...] = ()

    def deviations(self, name: str) -> float:
        return self.off[name] / self.stated[name]

    @property
    def is_wrong(self) -> bool:
        return self.verdict == "sure" and abs(self.off["period"]) > WRONG


def lamp_trial(seed: int) -> LampTrial:
    """Match a drawn lamp; the seed says, too, what is known of it."""
    return trial_of(lamp_view(seed), seed)


def trial_of(view: LampView, seed: int) -> LampTrial:
    known, estimate = KNOWN[seed % 3], ESTIMATES[seed // 3 % 2]
    classes = {**view.classes, "known": known}
    readout = 1.0 / (FREQUENCY * view.period)
    scene = occ.load_preset("phone-136us").replace(
        light="lamp", lamp_frequency=FREQUENCY, readout_time=readout
    )
    photo = photo_of(view.image)
    if known == "duty known":
        scene = scene.replace(duty=view.duty)
    elif known == "exposure noted":
        noted = math.exp(_NOTE_ERROR * np.random.default_rng([6709, seed]).standard_normal())
        photo = replace(photo, exposure_time=view.exposure / FREQUENCY * noted)
    sent = "scene" if known == "duty known" else "auto"
    try:
        match = occ.match_photo(photo, scene, estimate=estimate, sent=sent)
    except occ.MatchError as why:
        return LampTrial(seed, "refused", classes=classes, says=why.reasons)
    errors = match.uncertainties
    found, name, right = (
        (match.readout_time, "readout_time", readout)
        if estimate == "readout_time"
        else (match.lamp_frequency or 0.0, match.estimate, FREQUENCY)
    )
    frequency = match.lamp_frequency or FREQUENCY
    off, stated = {"period": found / right - 1.0}, {"period": errors[name] / right}
    duty, exposure = match.duty or 0.0, match.exposure_time * frequency
    stated["exposure"] = errors["exposure_time"] * frequency
    alike = view.duty, view.exposure
    if "duty" in errors:
        stated["duty"] = errors["duty"]
        alike = _nearest(view, duty / errors["duty"], exposure / stated["exposure"], stated)
        off["duty"] = duty - alike[0]
    off["exposure"] = exposure - alike[1]
    # Which of the readings is right is another question than how near it is.
    unsure = [why for why in match.exposure_reasons if _ALIKE not in why]
    shape_verdict = "doubtful" if unsure or match.verdict != "sure" else "sure"
    is_misread = match.exposure_verdict == "sure" and known != "neither" and (
        abs(exposure - view.exposure) > _MISREAD * stated["exposure"]
    )  # fmt: skip
    return LampTrial(
        seed, match.verdict, shape_verdict, is_misread, off, stated, classes, match.all_reasons
    )


def _nearest(
    view: LampView, duty: float, exposure: float, stated: dict[str, float]
) -> tuple[float, float]:
    """Return which duty and exposure that make the same stripes are nearest to those found."""
    whole = math.floor(view.exposure)
    rest = view.exposure - whole
    alike = [(view.duty, rest), (rest, view.duty), (1 - rest, 1 - view.duty),
             (1 - view.duty, 1 - rest)]  # fmt: skip
    every = [(one, other + more) for one, other in alike for more in range(4)]
    return min(
        every,
        key=lambda one: math.hypot(
            duty - one[0] / stated["duty"], exposure - one[1] / stated["exposure"]
        ),
    )


def coverage(trials: Iterable[LampTrial], name: str) -> tuple[int, float, float, float, float]:
    """Return how many sure answers state an error, shares within 1 and 2, the worst, its median."""
    sure = [
        one
        for one in trials
        if (one.verdict if name == "period" else one.shape_verdict) == "sure" and name in one.off
    ]
    away = np.abs([one.deviations(name) for one in sure])
    if not sure:
        return 0, math.nan, math.nan, math.nan, math.nan
    stated = float(np.median([one.stated[name] for one in sure]))
    return len(sure), float(np.mean(away < 1)), float(np.mean(away < 2)), float(away.max()), stated


def report(trials: Sequence[LampTrial]) -> list[str]:
    """Write verdicts, coverage of each error, and verdicts and coverage by class."""
    lines = [
        f"{len(trials)} lamps: {_counts(trials)}; {sum(one.is_wrong for one in trials)} wrong, "
        f"{sum(one.is_misread for one in trials)} misread"
    ]
    lines += [_line(name, *coverage(trials, name)) for name in ("period", "duty", "exposure")]
    for kind in trials[0].classes:
        for value in sorted({one.classes[kind] for one in trials}, key=_order):
            part = [one for one in trials if one.classes[kind] == value]
            _, one, two, worst, _ = coverage(part, "period")
            shares = f"{100 * one:4.0f} {100 * two:4.0f} {worst:5.1f}"
            lines.append(f"{kind:17} {value:15} {_counts(part):44} {shares}")
    return lines


def _line(name: str, count: int, one: float, two: float, worst: float, stated: float) -> str:
    return (
        f"{name:9} {count:4} sure: {100 * one:.0f} and {100 * two:.0f} % within 1 and 2, "
        f"worst {worst:.1f}; half state less than {stated:.2g}"
    )


def _order(value: str) -> tuple[bool, float, str]:
    *_, last = value.split()
    number = float(last) if last.replace(".", "").isdigit() else math.inf
    return not value.startswith("below"), number, value


def _counts(trials: Sequence[LampTrial]) -> str:
    counts = Counter(one.verdict for one in trials)
    return ", ".join(f"{counts[each]} {each}" for each in _VERDICTS)
