"""What effects cost and change: their computing times, what leaving them out would change."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import fsum
from typing import Self

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.frame import Frame
from occ_model.results.plan import Plan, Way


@dataclass(frozen=True, slots=True)
class TimeShares:
    """The computing time of one picture, divided among its effects and all the rest."""

    effects: Mapping[str, float]  # Seconds of each effect that was computed by itself
    stages: Mapping[str, float]  # Seconds of each other stage of the simulation
    # Effects that were computed in one step with another, and which effect's time it counts to
    together: Mapping[str, str]
    # Whether rows were computed one by one: not where only effects on whole columns are included
    rows_differ: bool
    # Seconds by which each effect took longer in other runs, where the picture was made again
    scatter: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, frame: Frame) -> Self:
        """Divide the time of a picture, as it was measured while the picture was made."""
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
        """Take of each effect and stage its fastest run: what else is busy only adds to a time."""
        first = runs[0]
        effects = {name: sorted(run.effects[name] for run in runs) for name in first.effects}
        return cls(
            effects={name: times[0] for name, times in effects.items()},
            stages={name: min(run.stages[name] for run in runs) for name in first.stages},
            together=first.together,
            rows_differ=first.rows_differ,
            # Half of the runs are faster: a single one that was held up says nothing.
            scatter={name: times[len(times) // 2] - times[0] for name, times in effects.items()},
        )

    @property
    def included(self) -> frozenset[str]:
        """The effects of the picture."""
        return frozenset((*self.effects, *self.together))

    @property
    def everything_else(self) -> float:
        """The seconds that belong to no effect."""
        return fsum(self.stages.values())

    @property
    def seconds(self) -> float:
        """The seconds of the whole picture: those of the effects and of everything else."""
        return fsum((*self.effects.values(), *self.stages.values()))


@dataclass(frozen=True, eq=False, slots=True)
class EffectCrop:
    """A part of the panel that shows an effect best: the paper's model with it, and without it."""

    # Shape (rows, columns): the camera's pixels, both stretched in the same way to the full range
    # of grey
    with_effect: ByteArray
    without: ByteArray
    # Shape (rows, columns): the first less the second in grey levels, multiplied by
    # ``amplification``, around 128
    difference: ByteArray
    amplification: int
    # Whether it is the whole panel, reduced by averaging areas; otherwise real pixels
    is_averaged: bool


@dataclass(frozen=True, eq=False, slots=True)
class EffectDifference:
    """What leaving one effect out of the complete simulation changes."""

    effect: str
    # Root mean square of the change of the observable, in levels of the stretched profile
    error: float
    # Shape (samples,): the change in some places, the same for all effects of a scene, with this
    # root mean square
    change: FloatArray
    # How the effect alone looks: at a size to look at closely, and that of a line of text
    crop: EffectCrop
    icon: EffectCrop


@dataclass(frozen=True, slots=True)
class MeasuredCosts:
    """What has been measured of a scene's effects, as far as it has been."""

    picture: TimeShares
    # Those of pictures of its scene that were made in turn, among them one with all effects and one
    # with none: the first gives the times of effects that the picture leaves out, the second that
    # of everything else where no effect makes rows differ
    others: tuple[TimeShares, ...] = ()
    differences: Mapping[str, EffectDifference] = field(default_factory=dict)
    # Errors measured as a whole, by the effects of the scene that are included
    errors: Mapping[frozenset[str], float] = field(default_factory=dict)

    @property
    def is_comparable(self) -> bool:
        """Whether the picture's times were measured in turn with the others, not at another time.

        A first picture takes longer than one that is made again, and all take longer while the
        machine is busy.
        """
        return any(shares is self.picture for shares in self.others)

    def seconds_of(self, effect: str) -> float | None:
        """Return an effect's time in the last picture or, if not in there, in another."""
        for shares in (self.picture, *self.others):
            if effect in shares.effects or effect in shares.together:
                return shares.effects[shares.together.get(effect, effect)]
        return None

    def scatter_of(self, effect: str) -> float:
        """Return by how many seconds an effect took longer in other runs; 0 where it ran once."""
        for shares in (self.picture, *self.others):
            if effect in shares.effects:
                return shares.scatter.get(effect, 0.0)
        return 0.0

    def shares_step_with(self, effect: str) -> str | None:
        """Return the effect of the last picture in whose step this one is computed, or would be."""
        for shares in (self.picture, *self.others):
            other = shares.together.get(effect)
            if other in self.picture.effects:
                return other
        return None


@dataclass(frozen=True, slots=True)
class Forecast:
    """What a simulation with other settings would take, and how exact it would be."""

    plan: Plan
    seconds: float | None  # Its expected time, None where a time is not known yet
    # Its expected error, root mean square in levels of the stretched profile: that of the changes
    # of all effects left out, added up as if none influenced another. None where a change is not
    # known yet.
    error: float | None
    is_measured: bool
    ways: tuple[Way, ...] = ()  # What the plan chooses among, the fastest first: see ways_of
    # What a picture of each is expected to take, None where a time is not known yet
    ways_seconds: tuple[float | None, ...] = ()
