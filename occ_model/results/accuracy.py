"""Time and error of each simulation method, and of each effect that is computed or left out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import fsum
from typing import Self

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.frame import Frame
from occ_model.results.plan import EffectSet, Plan
from occ_model.scene.units import LEVEL

ACCURACY_PARTS = {  # titles of the parts of an accuracy study, by name
    "integration": "exposure: samples in time, closed form",
    "effects": "effects, one after the other",
    "path": "columns alone, whole pictures",
    "draft": "drafts: every k-th row of the picture",
    "noise": "noise drawn, noise used again",
}

CHAINED_PARTS = ("integration", "effects")  # points form a curve, but for the present settings'
CLOSED_FORM = "closed form"  # name of the exposure that is integrated exactly

LEAST_ERROR = 1e-3
"""Smallest error drawn, in levels of the stretched profile; smaller ones are drawn there."""


@dataclass(frozen=True, slots=True)
class AccuracyPoint:
    part: str  # The part of the study: a name from ``ACCURACY_PARTS``
    name: str
    seconds: float
    error: float  # Root mean square difference from the most exact way
    current: bool = False  # Whether the present settings simulate in this way: one point of a study
    effects: tuple[str, ...] = ()
    unit: str = LEVEL.symbol  # Of the error: of the stretched profile, or of a decision


@dataclass(frozen=True, slots=True)
class TimeFractions:
    """Computing time of one picture, divided among its effects and other stages."""

    effects: Mapping[str, float]  # Seconds of each effect computed separately
    stages: Mapping[str, float]  # Seconds of each other stage of the simulation
    # Effects computed in one step with another, and the effect whose time includes theirs
    together: Mapping[str, str]
    # Whether rows differ: not with column effects only
    rows_differ: bool
    # Seconds by which each effect's median run was slower than its fastest
    scatter: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, frame: Frame) -> Self:
        """Return the times measured while a picture was simulated."""
        included = frame.plan.included
        noises = [d.effect for d in frame.plan.decisions if d.included and d.kind == "noise"]
        timed = {name: frame.timings[name] for name in included if name in frame.timings}
        return cls(
            effects=timed,
            stages={name: s for name, s in frame.timings.items() if name not in timed},
            together={name: noises[-1] for name in noises if name not in timed},
            rows_differ=not frame.plan.kinds <= {"column"},
        )

    @classmethod
    def of_runs(cls, runs: Sequence[Self]) -> Self:
        """Return the fastest run of each effect and stage: other load only adds time."""
        first = runs[0]
        effects = {name: sorted(run.effects[name] for run in runs) for name in first.effects}
        return cls(
            effects={name: times[0] for name, times in effects.items()},
            stages={name: min(run.stages[name] for run in runs) for name in first.stages},
            together=first.together,
            rows_differ=first.rows_differ,
            # The median: a single slow run has no influence.
            scatter={name: times[len(times) // 2] - times[0] for name, times in effects.items()},
        )

    @property
    def included(self) -> frozenset[str]:
        return frozenset((*self.effects, *self.together))

    @property
    def everything_else(self) -> float:
        return fsum(self.stages.values())

    @property
    def seconds(self) -> float:
        return fsum((*self.effects.values(), *self.stages.values()))


@dataclass(frozen=True, eq=False, slots=True)
class EffectCrop:
    """The part of the panel that shows an effect best, with and without it on the paper's model."""

    # Shape (rows, columns): camera's pixels, both with the same contrast stretch
    with_effect: ByteArray
    without: ByteArray
    # Shape (rows, columns): the first minus the second in grey levels, times ``amplification``,
    # around 128
    difference: ByteArray
    amplification: int
    # Whether it is the area-averaged whole panel; otherwise real pixels
    is_averaged: bool


@dataclass(frozen=True, eq=False, slots=True)
class EffectDifference:
    """Change caused by omitting one effect from the complete simulation."""

    effect: str
    # Root mean square of the change of the observable, in levels of the stretched profile
    error: float
    # Shape (samples,): the change at sample places, the same for all effects of a scene, with this
    # RMS
    change: FloatArray
    # The effect alone: at viewing size, and at the size of a line of text
    crop: EffectCrop
    icon: EffectCrop


@dataclass(frozen=True, slots=True)
class MeasuredCosts:
    picture: TimeFractions
    # Of pictures simulated alternately, among them one with all effects, which times those omitted,
    # and one with none, which times everything else where all rows are equal
    others: tuple[TimeFractions, ...] = ()
    differences: Mapping[str, EffectDifference] = field(default_factory=dict)
    # Measured total errors, by set of included effects
    errors: Mapping[frozenset[str], float] = field(default_factory=dict)

    @property
    def is_comparable(self) -> bool:
        """Whether the picture was timed in turn with the others: a first one takes longer."""
        return any(fractions is self.picture for fractions in self.others)

    def seconds_of(self, effect: str) -> float | None:
        """Return an effect's time in the last picture, otherwise in another."""
        for fractions in (self.picture, *self.others):
            if effect in fractions.effects or effect in fractions.together:
                return fractions.effects[fractions.together.get(effect, effect)]
        return None

    def scatter_of(self, effect: str) -> float:
        """Return the scatter of an effect's time in seconds; 0 for a single run."""
        for fractions in (self.picture, *self.others):
            if effect in fractions.effects:
                return fractions.scatter.get(effect, 0.0)
        return 0.0

    def shares_step_with(self, effect: str) -> str | None:
        """Return the effect of the last picture whose step includes, or would include, this one."""
        for fractions in (self.picture, *self.others):
            other = fractions.together.get(effect)
            if other in self.picture.effects:
                return other
        return None


@dataclass(frozen=True, slots=True)
class Forecast:
    """Expected time and error of a simulation with other settings."""

    plan: Plan
    seconds: float | None  # None where a time is not yet known
    # RMS in levels of the stretched profile, of the sum of the changes of all omitted effects as if
    # they were independent; None where a change is not yet known
    error: float | None
    is_measured: bool
    effect_sets: tuple[
        EffectSet, ...
    ] = ()  # Alternatives of the plan, fastest first: see `ways_of`
    # Expected time of each, None where not yet known
    ways_seconds: tuple[float | None, ...] = ()
