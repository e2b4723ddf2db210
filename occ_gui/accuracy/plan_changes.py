"""Changes of the simulation plan: the effects that it last switched in or out."""

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.frame import Frame
from occ_model.results.plan import Decision

_NEW_MS = 8000  # for how long what the plan has switched is marked, and stated in the status line


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
        self.switched = ()


class PlanNews(QObject):
    """Tells for a while what the plan of the latest picture has switched."""

    changed = Signal(object)  # the decisions that are new; none when they are no news any more

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._changes = PlanChanges()
        self._forgetting = QTimer(self, singleShot=True)
        self._forgetting.setInterval(_NEW_MS)
        self._forgetting.timeout.connect(self._forget)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        if self._changes.update(snapshot.frame):
            self.changed.emit(self._changes.switched)
            self._forgetting.start()

    def _forget(self) -> None:
        self._changes.forget()
        self.changed.emit(())
