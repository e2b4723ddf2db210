"""Undo and redo in a field: of what is being typed, else of the scene."""

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QAbstractSpinBox, QLineEdit

_KEYS = (QKeySequence.StandardKey.Undo, QKeySequence.StandardKey.Redo)


class _UndoKeys(QObject):
    """Leaves the keys to the window while the field holds nothing half typed."""

    def __init__(self, field: QLineEdit | QAbstractSpinBox) -> None:
        super().__init__(field)
        self._line = field.lineEdit() if isinstance(field, QAbstractSpinBox) else field
        field.editingFinished.connect(lambda: self._line.setModified(False))
        field.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and isinstance(event, QKeyEvent)
            and not self._line.isModified()
            and any(event.matches(key) for key in _KEYS)
        ):
            event.ignore()
            return True
        return super().eventFilter(watched, event)


def leave_undo_to_window(field: QLineEdit | QAbstractSpinBox) -> None:
    """Let a field take the keys of undo and redo only while something is typed into it.

    A line takes them always, also where it has nothing to undo: right after a value is entered, the
    step that the user wants back is the scene's.
    """
    _UndoKeys(field)
