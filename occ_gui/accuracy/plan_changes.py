"""Changes of the simulation plan: the effects that it has just switched in or out."""

from collections.abc import Sequence

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.frame import Decision, Frame

_MARK_MS = 8000  # how long a change of the plan is marked and stated in the status line


class PlanChanges(QObject):
    """Reports for a while which effects the plan of the latest picture has switched."""

    changed = Signal(object)  # the new decisions; none after a while

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._previous_frame: Frame | None = None
        self.mark_timer = QTimer(self, singleShot=True)
        self.mark_timer.setInterval(_MARK_MS)
        self.mark_timer.timeout.connect(self._end)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        previous, self._previous_frame = self._previous_frame, snapshot.frame
        if previous is None:
            return
        plan = snapshot.frame.plan
        switched = set(previous.plan.included) ^ set(plan.included)
        if switched:
            self.changed.emit(tuple(d for d in plan.decisions if d.effect in switched))
            self.mark_timer.start()

    def _end(self) -> None:
        self.changed.emit(())


def describe_switches(switched: Sequence[Decision]) -> str:
    """Name the switched effects."""
    parts = []
    for included, direction in ((True, "in"), (False, "out")):
        labels = [decision.label for decision in switched if decision.included is included]
        if labels:
            parts.append(f"Switched {direction}: {', '.join(labels)}")
    return ". ".join(parts)
