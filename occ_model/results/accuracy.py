"""Computing time and error of each simulation method, and of each effect."""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import fsum
from typing import Self

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.frame import EffectSet, Frame, Plan
from occ_model.scene.units import LEVEL

ACCURACY_PARTS = {  # titles of the parts of an accuracy study, by name
    "integration": "exposure: samples in time, closed form",
    "effects": "effects, one after the other",
    "path": "columns alone, whole pictures",
    "draft": "drafts: every k-th row of the picture",
}

CHAINED_PARTS = ("integration", "effects")  # whose points form curves, except the present one
CLOSED_FORM = "closed form"  # name of the point whose exposure is integrated exactly

LEAST_ERROR = 1e-3
"""Smallest error in a plot, in levels of the stretched profile; smaller errors are drawn here."""


@dataclass(frozen=True, slots=True)
class AccuracyPoint:
    part: str  # The part of the study, a name of ``ACCURACY_PARTS``
    name: str
    seconds: float
    error: float  # Root mean square difference from the most exact simulation
    current: bool = False  # Whether it belongs to the present settings
    effects: tuple[str, ...] = ()
    unit: str = LEVEL.symbol  # Unit of the error: levels of the stretched profile, or margins


@dataclass(frozen=True, slots=True)
class Times:
    """Seconds that the same work took in several runs."""

    median: float  # of an even number, the lower of the middle two, so that it is a run's time
    least: float
    most: float
    count: int
    middle: tuple[float, float]  # the ends of the middle half of the runs

    @classmethod
    def of(cls, seconds: Iterable[float]) -> Self:
        runs = sorted(seconds)
        last = len(runs) - 1
        middle = runs[last // 4], runs[last - last // 4]
        return cls(runs[last // 2], runs[0], runs[-1], len(runs), middle)

    def is_below(self, other: "Times") -> bool:
        """Return whether it is shorter by more than the runs scatter.

        Each median must be outside of the middle half of the other's runs; the other half may have
        been slowed by a busy machine, as the first run is.
        """
        return self.median < other.middle[0] and self.middle[1] < other.median

    @property
    def number(self) -> str:
        """The median in milliseconds, with the digits that its scatter leaves."""
        return format_milliseconds(self.median, self._scatter)

    def __str__(self) -> str:
        if self.count == 1:
            return f"{self.number} ms"
        ends = (format_milliseconds(each, self._scatter) for each in (self.least, self.most))
        return f"{self.number} ms ({' to '.join(ends)})"

    @property
    def _scatter(self) -> float:
        return self.most - self.least


def format_milliseconds(seconds: float, scatter: float = 0.0) -> str:
    """Format seconds in milliseconds, with two to four digits, or to a tenth of the scatter."""
    time = 1e3 * seconds
    decimals = 0 if time >= 100.0 else 1 if time >= 1.0 else 1 - math.floor(math.log10(time or 1.0))
    if scatter > 0.0:
        decimals = min(decimals, 1 - math.floor(math.log10(1e3 * scatter)))
    return f"{round(time, decimals):.{max(decimals, 0)}f}"


def format_levels(error: float) -> str:
    return f"{error:.0f}" if 100.0 <= error < 1e5 else f"{error:.2g}"


@dataclass(frozen=True, slots=True)
class TimeFractions:
    """Computing time of one picture, divided among effects and other stages."""

    effects: Mapping[str, float]  # Seconds of each effect that is computed in a step of its own
    stages: Mapping[str, float]  # Seconds of each other stage of the simulation
    # For each effect without a time of its own, the effect whose time includes it
    shared_steps: Mapping[str, str]
    # Whether rows differ; with column effects only, they do not
    rows_differ: bool
    # Seconds by which the median run of each effect was slower than its fastest run
    scatter: Mapping[str, float] = field(default_factory=dict)
    # The times of all runs, if these are the times of the median run
    runs: Times | None = None

    @classmethod
    def of(cls, frame: Frame) -> Self:
        """Return the times that were measured during a picture's simulation."""
        included = frame.plan.included
        noises = [d.effect for d in frame.plan.decisions if d.included and d.kind == "noise"]
        effect_times = {name: frame.timings[name] for name in included if name in frame.timings}
        return cls(
            effects=effect_times,
            stages={name: s for name, s in frame.timings.items() if name not in effect_times},
            shared_steps={name: noises[-1] for name in noises if name not in effect_times},
            rows_differ=not frame.plan.kinds <= {"column"},
        )

    @classmethod
    def of_runs(cls, runs: Sequence[Self]) -> Self:
        """Return the fractions of the run of median time, which add up to the time of one run."""
        by_time = sorted(runs, key=lambda run: run.seconds)
        times = Times.of(run.seconds for run in runs)
        median = by_time[(len(runs) - 1) // 2]
        scatter = {}
        for name in median.effects:
            seconds = Times.of(run.effects[name] for run in runs)
            scatter[name] = seconds.median - seconds.least
        return replace(median, scatter=scatter, runs=times)

    @property
    def times(self) -> Times:
        """The times of all runs."""
        return self.runs or Times.of((self.seconds,))

    @property
    def included(self) -> frozenset[str]:
        return frozenset((*self.effects, *self.shared_steps))

    @property
    def other_seconds(self) -> float:
        return fsum(self.stages.values())

    @property
    def seconds(self) -> float:
        return fsum((*self.effects.values(), *self.stages.values()))


@dataclass(frozen=True, eq=False, slots=True)
class EffectCrop:
    """The part of the panel that shows an effect best, simulated with and without the effect."""

    # Shape (rows, columns): the camera's pixels, with the same contrast stretch in both
    with_effect: ByteArray
    without_effect: ByteArray
    # Shape (rows, columns): the difference in grey levels times ``amplification``, plus 128
    difference: ByteArray
    amplification: int
    # Whether it is the whole panel, averaged; otherwise it has real pixels
    is_averaged: bool


@dataclass(frozen=True, eq=False, slots=True)
class EffectDifference:
    """The change when one effect is omitted from the complete simulation."""

    effect: str
    # Root mean square change of the observable, in levels of the stretched profile
    error: float
    # Shape (samples,): the change at sample points, which are the same for all effects of a scene
    change: FloatArray
    # The effect alone, for display and at the size of a line of text
    crop: EffectCrop
    icon: EffectCrop


@dataclass(frozen=True, slots=True)
class MeasuredCosts:
    picture: TimeFractions
    # Times of the last pictures with other effects, of this size, the latest first: for the omitted
    # effects, and the other stages if all rows are equal
    others: tuple[TimeFractions, ...] = ()
    differences: Mapping[str, EffectDifference] = field(default_factory=dict)
    # Measured total error, by set of included effects
    errors: Mapping[frozenset[str], float] = field(default_factory=dict)
    draft: Times | None = None  # From a slider's move to the draft; None without one

    def times_with(self, effects: Collection[str]) -> Times | None:
        """Return the measured times of pictures with just these effects; None if there are none."""
        each = (self.picture, *self.others)
        return next((one.times for one in each if one.included == frozenset(effects)), None)

    def seconds_of(self, effect: str) -> float | None:
        """Return an effect's time in the last picture, or else in another one."""
        for fractions in (self.picture, *self.others):
            if effect in fractions.effects or effect in fractions.shared_steps:
                return fractions.effects[fractions.shared_steps.get(effect, effect)]
        return None

    def scatter_of(self, effect: str) -> float:
        """Return the scatter of an effect's time in seconds; 0 for a single run."""
        for fractions in (self.picture, *self.others):
            if effect in fractions.effects:
                return fractions.scatter.get(effect, 0.0)
        return 0.0

    def shares_step_with(self, effect: str) -> str | None:
        """Return the last picture's effect that is, or would be, computed with this one, if any."""
        for fractions in (self.picture, *self.others):
            other = fractions.shared_steps.get(effect)
            if other in self.picture.effects:
                return other
        return None


@dataclass(frozen=True, slots=True)
class Forecast:
    """Expected time and error of a simulation with other settings."""

    plan: Plan
    seconds: float | None  # None if a time is not yet known
    # RMS of all omitted changes together, taken as independent, in levels of the stretched profile;
    # None if one is not yet known
    error: float | None
    is_measured: bool
    effect_sets: tuple[EffectSet, ...] = ()  # Alternatives of the plan, fastest first
    # Expected seconds of each, None if not yet known
    effect_set_seconds: tuple[float | None, ...] = ()
