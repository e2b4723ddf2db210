"""Controller of the exposure plot: the column that the user points at or holds."""

from typing import Protocol

from PySide6.QtCore import QObject, Signal

from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.teaching import ExposureWindow
from occ_model.teaching.exposure_window import exposure_window


class ExposurePane(Protocol):
    def show_column(self, column: int, columns: int, held: bool) -> None:
        """Show which of the picture's columns is chosen, without emitting a signal."""

    def show_window(self, window: ExposureWindow, level: float) -> None:
        """Show a column's exposure, and the grey level that results from it."""


class ColumnMark(Protocol):
    def set_active(self, active: bool) -> None: ...

    def show_column(self, column: int, held: bool) -> None: ...


class ExposureController(QObject):
    """Keeps the chosen column, held or under the mouse, and computes its exposure while visible."""

    held = Signal(int)  # the column that the user has chosen, until another is

    def __init__(self, pane: ExposurePane, mark: ColumnMark) -> None:
        super().__init__()
        self._pane = pane
        self._mark = mark
        self._snapshot: Snapshot | None = None
        self._column: int | None = None
        self._held = False
        self._seen = False

    def set_seen(self, seen: bool) -> None:
        self._seen = seen
        self._mark.set_active(seen)
        self._show()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._show()

    def hover(self, column: int) -> None:
        """Show the column under the mouse, unless a column is held."""
        if not self._held:
            self._choose(column, held=False)

    def click(self, column: int) -> None:
        if self._held and column == self._column:
            self._choose(column, held=False)
        else:
            self.choose(column)

    def step(self, columns: int) -> None:
        if self._column is not None:
            self.choose(self._column + columns)

    def choose(self, column: int) -> None:
        self._choose(column, held=True)
        self.held.emit(self._column)

    def follow(self, column: int) -> None:
        if column != self._column:
            self._choose(column, held=self._held)

    def hold(self, held: bool) -> None:
        """Hold the column that is shown, or let the mouse choose the column."""
        self._held = held
        self._show()

    def _choose(self, column: int, held: bool) -> None:
        self._column, self._held = column, held
        self._show()

    def _show(self) -> None:
        snapshot = self._snapshot
        if snapshot is None or not self._seen:
            return
        profile = snapshot.frame.profile
        if self._column is None:  # in the first packet, which the profile shows
            self._column = int(snapshot.panel_origin[0] + snapshot.packet_columns / 2)
        self._column = min(max(self._column, 0), len(profile) - 1)
        self._pane.show_column(self._column, len(profile), self._held)
        self._mark.show_column(self._column, self._held)
        window = exposure_window(snapshot.frame.scene, self._column)
        self._pane.show_window(window, float(profile[self._column]))
