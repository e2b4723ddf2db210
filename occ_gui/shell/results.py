"""Results: what has been computed for the workspace, as one value that all panes read."""

from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal

from occ_gui.simulation.snapshot import Snapshot


@dataclass(frozen=True, eq=False, slots=True)
class Results:
    """What was computed last; each part says itself what it was computed from."""

    snapshot: Snapshot | None = None
    """The exact picture, and what is read of it."""


class Board(QObject):
    """Holds the results."""

    changed = Signal()
    """There are others."""

    def __init__(self) -> None:
        super().__init__()
        self.results = Results()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Put an exact picture in place of the last one."""
        self.results = replace(self.results, snapshot=snapshot)
        self.changed.emit()
