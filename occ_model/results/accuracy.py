"""Computing time and error of each simulation method, and of each effect."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
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
class TimeFractions:
    """Computing time of one picture, divided among effects and other stages."""

    effects: Mapping[str, float]  # Seconds of each effect that is computed in a step of its own
    stages: Mapping[str, float]  # Seconds of each other stage of the simulation
    # By effect without a time of its own: the effect whose time includes it
    shared_steps: Mapping[str, str]
    # Whether rows differ; with column effects only, they do not
    rows_differ: bool
    # Seconds by which the median run of each effect was slower than its fastest run
    scatter: Mapping[str, float] = field(default_factory=dict)

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
        """Take the fastest run of each effect and stage, since other load only adds time."""
        first = runs[0]
        effects = {name: sorted(run.effects[name] for run in runs) for name in first.effects}
        return cls(
            effects={name: times[0] for name, times in effects.items()},
            stages={name: min(run.stages[name] for run in runs) for name in first.stages},
            shared_steps=first.shared_steps,
            rows_differ=first.rows_differ,
            # By the median, a single slow run has no influence.
            scatter={name: times[len(times) // 2] - times[0] for name, times in effects.items()},
        )

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
    # Of pictures simulated in alternation: one with all effects, which times the omitted ones, and
    # one without effects, which times the other stages if all rows are equal
    others: tuple[TimeFractions, ...] = ()
    differences: Mapping[str, EffectDifference] = field(default_factory=dict)
    # Measured total error, by set of included effects
    errors: Mapping[frozenset[str], float] = field(default_factory=dict)

    @property
    def is_comparable(self) -> bool:
        """Whether the picture was timed in alternation with the others: a first one is slower."""
        return any(fractions is self.picture for fractions in self.others)

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
        """Return the effect of the last picture whose step computes, or would compute, this one."""
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
