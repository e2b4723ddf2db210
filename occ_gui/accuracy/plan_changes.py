"""Changes of the simulation plan: the effects that it last switched in or out."""

from collections.abc import Sequence

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.frame import Frame
from occ_model.results.plan import Decision

_NEW_MS = 8000  # for how long what the plan has switched is marked, and stated in the status line


class PlanNews(QObject):
    """Reports for a while what the plan of the latest picture has switched."""

    changed = Signal(object)  # the decisions that are new; none when they are no news any more

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._last: Frame | None = None
        self.pause = QTimer(self, singleShot=True)
        self.pause.setInterval(_NEW_MS)
        self.pause.timeout.connect(self._forget)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        last, self._last = self._last, snapshot.frame
        if last is None:
            return
        plan = snapshot.frame.plan
        switched = set(last.plan.included) ^ set(plan.included)
        if switched:
            self.changed.emit(tuple(d for d in plan.decisions if d.effect in switched))
            self.pause.start()

    def _forget(self) -> None:
        self.changed.emit(())


def switch_sentence(switched: Sequence[Decision]) -> str:
    """Name the effects that were switched; their times stand in the table only."""
    parts = []
    for included, way in ((True, "in"), (False, "out")):
        labels = [decision.label for decision in switched if decision.included is included]
        if labels:
            parts.append(f"Switched {way}: {', '.join(labels)}")
    return ". ".join(parts)
