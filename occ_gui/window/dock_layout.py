"""Dock layout: size of the window, mode and places of the panes, stored for the next start."""

from PySide6.QtCore import QByteArray, QObject
from PySide6.QtWidgets import QMainWindow

from occ_gui.files.preferences import Preferences
from occ_gui.window.modes.mode import MODES
from occ_gui.window.modes.mode_switch import ModeSwitch

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
        self._modes.layouts |= {name: kept for name, kept in layouts.items() if not kept.isEmpty()}
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
