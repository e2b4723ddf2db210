"""Changes of the simulation plan: the effects that it last switched in or out."""

from occ_model.results import Decision, Frame


class PlanChanges:
    """Compares each picture's plan with that of the previous picture."""

    def __init__(self) -> None:
        self._last: Frame | None = None
        self.switched: tuple[Decision, ...] = ()
        """The new decisions on the effects of the latest change, until they are forgotten."""

    def update(self, frame: Frame) -> bool:
        """Compare the next picture; return whether its plan includes other effects."""
        last, self._last = self._last, frame
        if last is None:
            return False
        before, after = set(last.plan.included), set(frame.plan.included)
        if before == after:
            return False
        self.switched = tuple(d for d in frame.plan.decisions if d.effect in before ^ after)
        return True

    def forget(self) -> None:
        """Take the latest change as known."""
        self.switched = ()
