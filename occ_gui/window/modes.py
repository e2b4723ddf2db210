"""Modes: the panes and layout of each task, and the change between modes."""

from binascii import crc32
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QByteArray, QObject, Qt, Signal
from PySide6.QtWidgets import QDockWidget, QMainWindow

from occ_gui.values.modes import MODES, PanePlace, Places, Side

_SIDES = {
    "left": Qt.DockWidgetArea.LeftDockWidgetArea,
    "right": Qt.DockWidgetArea.RightDockWidgetArea,
    "bottom": Qt.DockWidgetArea.BottomDockWidgetArea,
}


@dataclass(frozen=True, slots=True)
class DeclaredPane:
    dock: QDockWidget
    places: Places
    elsewhere: Side  # its side in modes that do not show it at first


class Panes(dict[str, DeclaredPane]):
    """The panes by name, and which of them each mode shows."""

    def shown_in(self, mode: str) -> dict[str, PanePlace]:
        """Return the places of the panes in a mode, the main ones first."""
        places = {name: pane.places[mode] for name, pane in self.items() if mode in pane.places}
        return dict(sorted(places.items(), key=lambda item: not item[1].is_main))

    def main_of(self, mode: str) -> str:
        """Return the main pane of a mode; empty if its subject is in the middle."""
        return next((name for name, at in self.shown_in(mode).items() if at.is_main), "")

    def home_of(self, name: str) -> str:
        """Return the mode whose main pane this is; empty if there is none."""
        return next((mode for mode, place in self[name].places.items() if place.is_main), "")

    def arrange(self, window: QMainWindow, mode: str) -> None:
        """Show the panes of a mode at their places, and hide all others."""
        for pane in self.values():
            window.removeDockWidget(pane.dock)
        layout = MODES[mode]
        corner = _SIDES["bottom"] if layout.is_bottom_wide else _SIDES["left"]
        window.setCorner(Qt.Corner.BottomLeftCorner, corner)
        corner = _SIDES["right"] if layout.is_right_high else _SIDES["bottom"]
        window.setCorner(Qt.Corner.BottomRightCorner, corner)
        places = self.shown_in(mode)
        for side, area in _SIDES.items():
            docks = [self[name].dock for name, place in places.items() if place.side == side]
            _show_as_tabs(window, area, docks)
        for name, pane in self.items():
            if name not in places:
                window.addDockWidget(_SIDES[pane.elsewhere], pane.dock)
                pane.dock.hide()
        for orientation, sizes in (
            (Qt.Orientation.Horizontal, {n: at.width for n, at in places.items() if at.width}),
            (Qt.Orientation.Vertical, {n: at.height for n, at in places.items() if at.height}),
        ):
            window.resizeDocks([self[n].dock for n in sizes], [*sizes.values()], orientation)


def _show_as_tabs(
    window: QMainWindow, area: Qt.DockWidgetArea, docks: Sequence[QDockWidget]
) -> None:
    if not docks:
        return
    front, *others = docks
    window.addDockWidget(area, front, Qt.Orientation.Vertical)
    front.show()
    for other in others:
        window.tabifyDockWidget(front, other)
        other.show()
    front.raise_()


_WIDEST_SIDE, _ANY_WIDTH = 360, 16_777_215
"""Pixels; the latter is Qt's value for no limit."""


class ModeSwitch(QObject):
    """The present mode of a window, and the layouts of the modes used before.

    ``panes``: may be added to until the first mode is shown. ``show_page``: shows the page of this
    name in the middle, or hides the middle if the name is empty.
    """

    changed = Signal(str)

    def __init__(
        self,
        window: QMainWindow,
        panes: Panes,
        show_page: Callable[[str], None],
    ) -> None:
        super().__init__(window)
        self._window, self.panes, self._show_page = window, panes, show_page
        self.mode = next(iter(MODES))
        self.layouts: dict[str, QByteArray] = {}
        """The last layouts of the other modes, by name."""
        self.is_shown = False  # whether the window has been laid out
        self.version = 0  # of stored layouts, so that those of other panes are ignored

    def begin(self) -> None:
        """Lay out the present mode, when the window is first shown."""
        self.is_shown = True
        self.version = crc32(",".join(self.panes).encode()) & 0x7FFF_FFFF
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
        """Restore the first layout of the present mode."""
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
            # The page beside the panes of the former mode might need a wider window, and Qt would
            # widen it, beyond the edge of the screen if it is maximized.
            for pane in self.panes.values():
                window.removeDockWidget(pane.dock)
            self._show_page(MODES[self.mode].centre)
            self._limit_sides()
            # Even if a layout is stored, because Qt leaves the tabs of the former mode behind.
            self.panes.arrange(window, self.mode)
            if self.mode in self.layouts:
                window.restoreState(self.layouts[self.mode], self.version)
            # A layout of a wider window would widen it.
            if window.size() != size and not window.isMaximized():
                window.resize(size)
        finally:
            window.setUpdatesEnabled(True)

    def _limit_sides(self) -> None:
        """Without a page, give all width that the window gains to the main pane.

        Qt would divide it among the panes.
        """
        has_page, places = bool(MODES[self.mode].centre), self.panes.shown_in(self.mode)
        for name, pane in self.panes.items():
            is_limited = not has_page and name in places and places[name].side == "left"
            pane.dock.setMaximumWidth(_WIDEST_SIDE if is_limited else _ANY_WIDTH)
