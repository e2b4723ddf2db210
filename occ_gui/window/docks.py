"""Modes and docks: which panes a mode shows and where, the pane in use, the stored layout."""

from binascii import crc32
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QByteArray, QEvent, QObject, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QMoveEvent, QResizeEvent
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QWidget

from occ_gui.files.preferences import Preferences
from occ_gui.values.modes import MODES, PICTURE, PanePlace, Places, Side

_SIDES = {
    "left": Qt.DockWidgetArea.LeftDockWidgetArea,
    "right": Qt.DockWidgetArea.RightDockWidgetArea,
    "bottom": Qt.DockWidgetArea.BottomDockWidgetArea,
}


@dataclass(frozen=True, slots=True)
class DeclaredPane:
    dock: QDockWidget
    places: Places
    default_side: Side  # its side in modes that do not show it at first


class Panes(dict[str, DeclaredPane]):
    """The panes by name, and which of them each mode shows."""

    def places_in(self, mode: str) -> dict[str, PanePlace]:
        """Return the places of the panes in a mode, the main ones first."""
        places = {name: pane.places[mode] for name, pane in self.items() if mode in pane.places}
        return dict(sorted(places.items(), key=lambda item: not item[1].is_main))

    def main_of(self, mode: str) -> str:
        """Return the main pane of a mode; empty if its subject is in the middle."""
        return next((name for name, place in self.places_in(mode).items() if place.is_main), "")

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
        places = self.places_in(mode)
        for side, area in _SIDES.items():
            docks = [self[name].dock for name, place in places.items() if place.side == side]
            _show_as_tabs(window, area, docks)
        for name, pane in self.items():
            if name not in places:
                window.addDockWidget(_SIDES[pane.default_side], pane.dock)
                pane.dock.hide()
        widths = {name: place.width for name, place in places.items() if place.width}
        heights = {name: place.height for name, place in places.items() if place.height}
        orientations = Qt.Orientation
        for orientation, sizes in (
            (orientations.Horizontal, widths), (orientations.Vertical, heights)
        ):  # fmt: skip
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


_WIDEST_SIDE = 26  # lines of text that a pane at the side may be wide
_ANY_WIDTH = 16_777_215  # pixels; Qt's value for no limit


class ModeSwitch(QObject):
    """The present mode of a window, and the last layouts of the other modes.

    ``panes``: may grow until the first mode is shown. ``show_page``: shows the page of this
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
        self.version = 0  # version of stored layouts; those with other panes are ignored

    def begin(self) -> None:
        """Lay out the present mode, when the window is first shown."""
        self.is_shown = True
        self.version = crc32(",".join(self.panes).encode()) & 0x7FFF_FFFF
        self._enter()

    def switch(self, name: str) -> None:
        """Change to a mode with its last layout; an unknown name changes nothing."""
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

    def collect_layouts(self) -> dict[str, QByteArray]:
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
            self.limit_sides()
            # Even if a layout is stored, because Qt leaves the tabs of the former mode behind.
            self.panes.arrange(window, self.mode)
            # Once more when the panes know what they need: each has the least height of when it
            # was last seen, and Qt leaves one that needs less now drawn over the status line.
            QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
            self.panes.arrange(window, self.mode)
            if self.mode in self.layouts:
                window.restoreState(self.layouts[self.mode], self.version)
            # A layout of a wider window would widen it.
            if window.size() != size and not window.isMaximized():
                window.resize(size)
        finally:
            window.setUpdatesEnabled(True)

    def limit_sides(self) -> None:
        """Without a page, give all width that the window gains to the main pane.

        Qt would divide it among the panes.
        """
        has_page, places = bool(MODES[self.mode].centre), self.panes.places_in(self.mode)
        for name, pane in self.panes.items():
            is_limited = not has_page and name in places and places[name].side == "left"
            widest = _WIDEST_SIDE * pane.dock.fontMetrics().height()
            pane.dock.setMaximumWidth(widest if is_limited else _ANY_WIDTH)


_OFFSET = 24  # pixels by which a pane moves when it starts to float, so that this is visible


def floating_place(place: QRect, screen: QRect) -> QRect:
    """Return the place of a floating pane: near its former place, and entirely on the screen."""
    size = QSize(min(place.width(), screen.width()), min(place.height(), screen.height()))
    corner = place.topLeft() + QPoint(_OFFSET, _OFFSET)
    return QRect(
        QPoint(
            max(screen.left(), min(corner.x(), screen.right() + 1 - size.width())),
            max(screen.top(), min(corner.y(), screen.bottom() + 1 - size.height())),
        ),
        size,
    )


class Dock(QDockWidget):
    opened_by_user = Signal()  # the user has opened it from the menu

    def __init__(self, name: str, title: str, content: QWidget, parent: QWidget) -> None:
        super().__init__(title, parent)
        self.setObjectName(name)
        self.setWidget(content)
        self._place = QRect()
        self.height_before = 0  # height of the window before the pane was shown
        self.topLevelChanged.connect(self._on_floated)
        self.toggleViewAction().triggered.connect(self._on_switched)
        self.hide()  # until a mode lays it out

    def _on_switched(self, on: bool) -> None:
        if on:
            self.opened_by_user.emit()

    def setVisible(self, visible: bool) -> None:  # noqa: N802 - Qt's name
        if visible:
            self.height_before = self.window().height()
        super().setVisible(visible)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._note_place()

    def moveEvent(self, event: QMoveEvent) -> None:  # noqa: N802 - Qt's name
        super().moveEvent(event)
        self._note_place()

    def _note_place(self) -> None:
        if not self.isFloating() and self.isVisible():
            self._place = QRect(self.mapToGlobal(QPoint()), self.size())

    def _on_floated(self, floats: bool) -> None:
        # Not while the user drags it.
        if floats and self._place.isValid() and QWidget.mouseGrabber() is not self:
            self.setGeometry(floating_place(self._place, self.screen().availableGeometry()))


class CurrentPane(QObject):
    def __init__(self, window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
        super().__init__(window)
        self._window = window
        self._docks = docks
        self.name = PICTURE
        for name, dock in docks.items():
            dock.visibilityChanged.connect(lambda on, name=name: self._on_visibility(name, on))
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.connect(self._on_focus)

    def _on_visibility(self, name: str, is_visible: bool) -> None:
        # When the window is first shown, docks become visible that the user has not chosen.
        tabs = self._window.tabifiedDockWidgets(self._docks[name])
        if is_visible and tabs and self._window.isActiveWindow():
            self.name = name

    def _on_focus(self, _old: QWidget | None, widget: QWidget | None) -> None:
        if widget is None or widget.window() is not self._window:
            return
        middle = self._window.centralWidget()
        if middle is not None and (widget is middle or middle.isAncestorOf(widget)):
            self.name = PICTURE
        for name, dock in self._docks.items():
            if dock.isAncestorOf(widget):
                self.name = name


_GEOMETRY, _MODE, _STATE = "window/geometry", "window/mode", "window/layout"


class DockLayout(QObject):
    """Stores position and size of the window, its mode, and the layout of each mode."""

    def __init__(self, window: QMainWindow, modes: ModeSwitch, preferences: Preferences) -> None:
        super().__init__(window)
        self._window, self._modes = window, modes
        self._preferences = preferences

    def restore(self) -> None:
        """Restore the window's position and size, its mode and the layouts, before it is shown."""
        recall = self._preferences.recall
        geometry = _bytes(recall(_GEOMETRY))
        if not geometry.isEmpty():
            self._window.restoreGeometry(geometry)
        layouts = {name: _bytes(recall(f"{_STATE}/{name}")) for name in MODES}
        self._modes.layouts |= {
            name: layout for name, layout in layouts.items() if not layout.isEmpty()
        }
        self._modes.switch(recall(_MODE))

    def keep(self) -> None:
        if not self._modes.is_shown:
            return
        self._preferences.keep(_GEOMETRY, _text(self._window.saveGeometry()))
        self._preferences.keep(_MODE, self._modes.mode)
        for name, layout in self._modes.collect_layouts().items():
            self._preferences.keep(f"{_STATE}/{name}", _text(layout))


def _text(content: QByteArray) -> str:
    return bytes(content.toBase64().data()).decode("ascii")


def _bytes(text: str) -> QByteArray:
    return QByteArray.fromBase64(QByteArray(text.encode("ascii", "replace")))
