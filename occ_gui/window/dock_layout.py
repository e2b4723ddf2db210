"""Dock layout: stored for the next start, and reset on demand."""

from binascii import crc32
from collections.abc import Iterable

from PySide6.QtCore import QByteArray, QObject
from PySide6.QtWidgets import QMainWindow

from occ_gui.files.preferences import Preferences

_GEOMETRY, _STATE = "window/geometry", "window/layout"


class DockLayout(QObject):
    """Stores position and size of the window and the layout of its docks.

    Parameters
    ----------
    window
        The window.
    docks
        Names of the docks; a stored layout of other docks is ignored.
    preferences
        Where they are stored.
    """

    def __init__(self, window: QMainWindow, docks: Iterable[str], preferences: Preferences) -> None:
        super().__init__(window)
        self._window = window
        self._preferences = preferences
        self._version = crc32(",".join(docks).encode()) & 0x7FFF_FFFF
        self._first = QByteArray()
        self._wanted = QByteArray()

    def restore(self) -> None:
        """Restore the window's position and size, and the docks as soon as it is shown."""
        geometry, self._wanted = (
            _bytes(self._preferences.recall(key)) for key in (_GEOMETRY, _STATE)
        )
        if not geometry.isEmpty():
            self._window.restoreGeometry(geometry)

    def note_first(self) -> None:
        """Note the default layout when the window is first shown, and restore the stored one."""
        self._first = self._window.saveState(self._version)
        if not self._wanted.isEmpty():
            self._window.restoreState(self._wanted, self._version)

    def reset(self) -> None:
        """Restore the default layout."""
        self._window.restoreState(self._first, self._version)

    def keep(self) -> None:
        """Store position, size and layout."""
        if self._first.isEmpty():  # never shown
            return
        self._preferences.keep(_GEOMETRY, _text(self._window.saveGeometry()))
        self._preferences.keep(_STATE, _text(self._window.saveState(self._version)))


def _text(content: QByteArray) -> str:
    return bytes(content.toBase64().data()).decode("ascii")


def _bytes(text: str) -> QByteArray:
    return QByteArray.fromBase64(QByteArray(text.encode("ascii", "replace")))
