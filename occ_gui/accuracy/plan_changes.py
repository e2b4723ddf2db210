"""Changes of the simulation plan: the effects that it last switched in or out."""

from dataclasses import dataclass

from occ_model.results import Decision, Frame


@dataclass(frozen=True, slots=True)
class Switch:
    """One effect that was switched into the simulation or out of it.

    Parameters
    ----------
    decision
        The plan's new decision on the effect.
    seconds
        Its computing time in the first picture with it, or in the last one before it was left out.
    """

    decision: Decision
    seconds: float


class PlanChanges:
    """Compares each picture's plan with that of the previous picture."""

    def __init__(self) -> None:
        self._last: Frame | None = None
        self.switches: tuple[Switch, ...] = ()
        """The effects of the latest change; they stay until the next change."""

    def update(self, frame: Frame) -> bool:
        """Compare the next picture; return whether its plan includes other effects."""
        last, self._last = self._last, frame
        if last is None:
            return False
        before, after = set(last.plan.included), set(frame.plan.included)
        if before == after:
            return False
        self.switches = tuple(
            Switch(d, (frame if d.included else last).timings.get(d.effect, 0.0))
            for d in frame.plan.decisions
            if d.effect in before ^ after
        )
        return True
