"""What the plan last switched in or out."""

from dataclasses import dataclass

from occ_model.results import Decision, Frame


@dataclass(frozen=True, slots=True)
class Switch:
    """One effect that came into the simulation or went out of it.

    Parameters
    ----------
    decision
        What the plan now does with the effect.
    seconds
        Time that it takes in the first picture with it, or took in the last one.
    """

    decision: Decision
    seconds: float


class PlanWatch:
    """Compares each picture's plan with that of the picture before."""

    def __init__(self) -> None:
        self._last: Frame | None = None
        self.switches: tuple[Switch, ...] = ()
        """The last effects that were switched at once; they stay until others are."""

    def see(self, frame: Frame) -> bool:
        """Take in the next picture; say whether its plan includes other effects."""
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
