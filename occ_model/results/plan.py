"""Result of planning: which effects are simulated, and why."""

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from occ_model.scene.simulation_settings import Observable

Stage: TypeAlias = Literal["light", "optics", "sensor", "processing"]
"""A stage of the light's way from the panel to the file."""


@dataclass(frozen=True, slots=True)
class Decision:
    """The decision of a plan on one effect.

    Parameters
    ----------
    effect
        Its name.
    label
        The field's term for it.
    kind
        ``"column"``: it leaves all rows of the panel alike; ``"noise"``: alike but for independent
        noise; ``"image"``: not alike.
    stage
        Where on the light's way it happens.
    estimate
        About how much leaving it out changes the observable, root mean square in levels of the
        stretched profile: close, and with an allowance above. 0 where the scene does not have the
        effect; of the observable ``"decision"`` in margins, 1 being where a chip could be read
        otherwise.
    limit
        The most that it changes, as far as a sample can show: what is compared with the tolerance.
    included
        Whether it is simulated.
    forced
        Whether the user decided so.
    why
        Why, in a few words.
    reason
        Why, as a sentence with the estimate and the decision.
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
class Way:
    """A set of effects, what it takes and how far it is from all."""

    effects: frozenset[str]  # Those that are simulated, of those that the scene has
    seconds: float  # What a picture takes, as measured on one computer
    error: float  # What the others change together, as in Plan


@dataclass(frozen=True, slots=True)
class Plan:
    """The effects that are simulated, and why.

    Parameters
    ----------
    tolerance
        Most change of the observable that is allowed by all effects left out, in levels of the
        stretched profile.
    observable
        The observable.
    decisions
        One for each effect, in the order that light travels.
    left_out
        What the effects that the plan, not the user, leaves out change together: at most the
        tolerance.
    stretch
        Levels of the stretched profile per grey level.
    saved
        Seconds that a picture takes less without what is left out, as measured on one computer.
    ways
        The sets of effects that no other is both faster and closer than, the fastest first.
    """

    tolerance: float
    observable: Observable
    decisions: tuple[Decision, ...]
    left_out: float
    stretch: float
    saved: float = 0.0
    ways: tuple[Way, ...] = field(default=(), repr=False)

    def __contains__(self, effect: object) -> bool:
        return any(d.effect == effect and d.included for d in self.decisions)

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
