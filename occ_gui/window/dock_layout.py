"""Where the panes are, kept over a start and put back on demand."""

from binascii import crc32
from collections.abc import Iterable

from PySide6.QtCore import QByteArray, QObject
from PySide6.QtWidgets import QMainWindow

from occ_gui.files.preferences import Memory

_GEOMETRY, _STATE = "window/geometry", "window/layout"


class Layout(QObject):
    """Keeps the window's place and size, and the layout of its docks.

    Parameters
    ----------
    window
        The window.
    docks
        Names of the docks: a layout of others is of another version, and left alone.
    memory
        Where they are kept.
    """

    def __init__(self, window: QMainWindow, docks: Iterable[str], memory: Memory) -> None:
        super().__init__(window)
        self._window = window
        self._memory = memory
        self._version = crc32(",".join(docks).encode()) & 0x7FFF_FFFF
        self._first = QByteArray()
        self._wanted = QByteArray()

    def restore(self) -> None:
        """Put the window where it was last, and lay its docks out so once it is shown."""
        geometry, self._wanted = (_bytes(self._memory.recall(key)) for key in (_GEOMETRY, _STATE))
        if not geometry.isEmpty():
            self._window.restoreGeometry(geometry)

    def note_first(self) -> None:
        """Note how the docks come, now that the window is shown, and put them where they were."""
        self._first = self._window.saveState(self._version)
        if not self._wanted.isEmpty():
            self._window.restoreState(self._wanted, self._version)

    def reset(self) -> None:
        """Lay the docks out as they come."""
        self._window.restoreState(self._first, self._version)

    def keep(self) -> None:
        """Keep window and docks as they are."""
        if self._first.isEmpty():  # never shown
            return
        self._memory.keep(_GEOMETRY, _text(self._window.saveGeometry()))
        self._memory.keep(_STATE, _text(self._window.saveState(self._version)))


def _text(content: QByteArray) -> str:
    return bytes(content.toBase64().data()).decode("ascii")


def _bytes(text: str) -> QByteArray:
    return QByteArray.fromBase64(QByteArray(text.encode("ascii", "replace")))
