"""Docks: the dock of a pane, which may float; the current pane; and the stored layout."""

from collections.abc import Mapping

from PySide6.QtCore import QByteArray, QObject, QPoint, QRect, QSize, Signal
from PySide6.QtGui import QMoveEvent, QResizeEvent
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QWidget

from occ_gui.files.preferences import Preferences
from occ_gui.values.modes import MODES, PICTURE
from occ_gui.window.modes import ModeSwitch

_OFFSET = 24  # pixels from its place to which a pane moves, so that it is seen to float


def floating_place(place: QRect, screen: QRect) -> QRect:
    """Return the place of a floating pane: near its former place, and whole on the screen."""
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
        self.height_before = 0  # of the window, before the pane was shown
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

    def _on_focus(self, _before: QWidget | None, now: QWidget | None) -> None:
        if now is None or now.window() is not self._window:
            return
        middle = self._window.centralWidget()
        if middle is not None and (now is middle or middle.isAncestorOf(now)):
            self.name = PICTURE
        for name, dock in self._docks.items():
            if dock.isAncestorOf(now):
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
        self._modes.layouts |= {name: each for name, each in layouts.items() if not each.isEmpty()}
        self._modes.switch(recall(_MODE))

    def keep(self) -> None:
        if not self._modes.is_shown:
            return
        self._preferences.keep(_GEOMETRY, _text(self._window.saveGeometry()))
        self._preferences.keep(_MODE, self._modes.mode)
        for name, layout in self._modes.present_layouts().items():
            self._preferences.keep(f"{_STATE}/{name}", _text(layout))


def _text(content: QByteArray) -> str:
    return bytes(content.toBase64().data()).decode("ascii")


def _bytes(text: str) -> QByteArray:
    return QByteArray.fromBase64(QByteArray(text.encode("ascii", "replace")))
