"""A plan: which effects are simulated, and why."""

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from occ_model.scene.scene import Observable, unit_of

Stage: TypeAlias = Literal[
    "light", "optics", "sensor", "processing"
]  # in the order of the path of light


@dataclass(frozen=True, slots=True)
class Decision:
    """The decision of a plan on one effect.

    Parameters
    ----------
    label
        The effect's usual name in the field.
    kind
        ``"column"``: all rows of the panel stay alike; ``"noise"``: alike except for independent
        noise; ``"image"``: they differ.
    estimate
        Estimated change of the observable without the effect, RMS in levels of the stretched
        profile, with an allowance; 0 if the scene does not have it. For the observable
        ``"decision"`` it is in decision margins: at 1 a chip could be misread.
    limit
        Upper bound of the change, as far as a sample shows it, which is compared with the
        tolerance. Infinite if no bound is known.
    forced
        Whether the user has decided.
    why
        The reason in a few words.
    reason
        The reason as a sentence with the estimate and the decision.
    """

    effect: str
    label: str
    kind: str
    stage: Stage
    estimate: float
    limit: float
    included: bool
    forced: bool
    why: str
    reason: str


@dataclass(frozen=True, slots=True)
class EffectSet:
    """A set of simulated effects, with its time and error."""

    effects: frozenset[str]  # The simulated ones among the scene's effects
    seconds: float  # Of a picture, as measured on one computer
    error: float  # Combined change by the others, as in Plan


@dataclass(frozen=True, slots=True)
class Plan:
    """The effects that are simulated, and why.

    Parameters
    ----------
    tolerance
        Allowed change of the observable by all omitted effects, in levels of the stretched profile.
    decisions
        One for each effect, in the order of the light path.
    left_out
        Combined change of the effects that the plan (not the user) omits, at most the tolerance.
    error
        Combined change of all omitted effects, by the plan or by the user; infinite where it is not
        known, NaN of a plan without estimates.
    stretch
        Levels of the stretched profile per grey level.
    saved
        Seconds saved for each picture by the omitted effects, as measured on one computer.
    effect_sets
        The Pareto front of sets of effects in time and error, fastest first.
    """

    tolerance: float
    observable: Observable
    decisions: tuple[Decision, ...]
    left_out: float
    error: float
    stretch: float
    saved: float = 0.0
    effect_sets: tuple[EffectSet, ...] = field(default=(), repr=False)

    def __contains__(self, effect: object) -> bool:
        return any(d.effect == effect and d.included for d in self.decisions)

    @property
    def unit(self) -> str:
        """The unit of the tolerance, of estimates and of errors."""
        return unit_of(self.observable)

    @property
    def included(self) -> tuple[str, ...]:
        """The names of the effects that are simulated."""
        return tuple(d.effect for d in self.decisions if d.included)

    @property
    def kinds(self) -> frozenset[str]:
        """The kinds of the effects that are simulated."""
        return frozenset(d.kind for d in self.decisions if d.included)

    def __str__(self) -> str:
        return "\n".join(f"{d.label}: {d.reason}" for d in self.decisions)
