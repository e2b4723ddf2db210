"""Mode switch: changes between the modes; each comes back as the user left it."""

from binascii import crc32
from collections.abc import Callable, Mapping

from PySide6.QtCore import QByteArray, QObject, Signal
from PySide6.QtWidgets import QDockWidget, QMainWindow

from occ_gui.window.modes.arrangement import arrange
from occ_gui.window.modes.mode import MODES, Mode

_WIDEST_SIDE, _ANY_WIDTH = 360, 16_777_215
"""Pixels; the latter is Qt's, by which a size is not limited."""


class ModeSwitch(QObject):
    """The present mode of a window, and the layouts of those that were used before.

    ``docks``: its docks, by name; they may still be added to until the first mode is shown.
    ``show_page``: shows a page in the middle by its name, or hides the middle where that is empty.
    """

    changed = Signal(str)

    def __init__(
        self,
        window: QMainWindow,
        docks: Mapping[str, QDockWidget],
        show_page: Callable[[str], None],
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._show_page = window, docks, show_page
        self.mode = next(iter(MODES))
        self.layouts: dict[str, QByteArray] = {}
        """What the other modes' layouts were when they were left, by name."""
        self.is_shown = False  # whether the window has been laid out
        self.version = 0  # the version of stored layouts: one of other panes is ignored

    def begin(self) -> None:
        """Lay out the present mode, when the window is first shown."""
        self.is_shown = True
        self.version = crc32(",".join(self._docks).encode()) & 0x7FFF_FFFF
        self._enter()

    def switch(self, name: str) -> None:
        """Change to a mode, laid out as it was left; an unknown name changes nothing."""
        if name == self.mode or name not in MODES:
            return
        if self.is_shown:
            self.layouts[self.mode] = self._window.saveState(self.version)
        self.mode = name
        if self.is_shown:
            self._enter()
        self.changed.emit(name)

    def reset(self) -> None:
        """Lay out the present mode as it was at first."""
        self.layouts.pop(self.mode, None)
        self._enter()

    def present_layouts(self) -> dict[str, QByteArray]:
        if not self.is_shown:
            return dict(self.layouts)
        return {**self.layouts, self.mode: self._window.saveState(self.version)}

    def _enter(self) -> None:
        window = self._window
        size = window.size()
        window.setUpdatesEnabled(False)
        try:
            # Beside the panes of the mode before it the page might need a wider window, and Qt
            # would widen it, over the edge of the screen where it is maximized.
            for dock in self._docks.values():
                window.removeDockWidget(dock)
            self._show_page(MODES[self.mode].centre)
            self._limit_sides(MODES[self.mode])
            # First even where a layout is known: Qt leaves the tabs of the mode before it behind.
            arrange(window, self._docks, MODES[self.mode])
            if self.mode in self.layouts:
                window.restoreState(self.layouts[self.mode], self.version)
            # A layout of a wider window would widen it.
            if window.size() != size and not window.isMaximized():
                window.resize(size)
        finally:
            window.setUpdatesEnabled(True)

    def _limit_sides(self, mode: Mode) -> None:
        """Leave what the window gains in width to the main pane where there is no page.

        Qt would share it between the panes.
        """
        sides = {name for group in mode.left for name in group}
        for name, dock in self._docks.items():
            is_limited = not mode.centre and name in sides
            dock.setMaximumWidth(_WIDEST_SIDE if is_limited else _ANY_WIDTH)
