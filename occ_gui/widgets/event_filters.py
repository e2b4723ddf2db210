"""Event filters: mouse wheel, double click, undo keys, dropped files, and changes of a widget."""

import re
from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence, QMouseEvent
from PySide6.QtWidgets import QAbstractSpinBox, QLineEdit, QWidget

_UNDO_KEYS = (QKeySequence.StandardKey.Undo, QKeySequence.StandardKey.Redo)

_NUMBER = re.compile(r"[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?")


class _WheelFilter(QObject):
    """Passes wheel events to the page while the control does not have the focus."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() == QEvent.Type.Wheel and isinstance(watched, QWidget):
            if watched.hasFocus():
                return False
            event.ignore()
            return True
        return False


def keep_wheel_for_scrolling(control: QWidget) -> None:
    """Let the wheel change a control only while it has the focus; otherwise, scroll the page."""
    control.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    control.installEventFilter(_WheelFilter(control))


class _NumberFilter(QObject):
    """Selects all of a number that is double-clicked; Qt would stop at the decimal point."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if (
            event.type() == QEvent.Type.MouseButtonDblClick
            and isinstance(event, QMouseEvent)
            and event.button() == Qt.MouseButton.LeftButton
            and isinstance(watched, QLineEdit)
        ):
            place = watched.cursorPositionAt(event.position().toPoint())
            watched.mouseDoubleClickEvent(event)  # so that a third click selects the whole text
            for match in _NUMBER.finditer(watched.text()):
                if match.start() <= place <= match.end():
                    watched.setSelection(match.start(), match.end() - match.start())
                    break
            return True
        return False


def select_number_on_double_click(field: QAbstractSpinBox) -> None:
    """Let a double click select a number with its decimals, and without its unit."""
    line = field.lineEdit()
    line.installEventFilter(_NumberFilter(line))


class _UndoKeyFilter(QObject):
    """Leaves the undo keys to the window while the field contains no unfinished input."""

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
            and any(event.matches(key) for key in _UNDO_KEYS)
        ):
            event.ignore()
            return True
        return super().eventFilter(watched, event)


def leave_undo_to_window(field: QLineEdit | QAbstractSpinBox) -> None:
    """Let a field use the undo and redo keys only while its input is unfinished.

    A line edit always uses them, even if it has nothing to undo. Once a value is entered, undo
    should revert the last change of the scene.
    """
    _UndoKeyFilter(field)


class _EventCaller(QObject):
    def __init__(
        self, widget: QWidget, function: Callable[[], object], kinds: tuple[QEvent.Type, ...]
    ) -> None:
        super().__init__(widget)
        self._function, self._kinds = function, kinds
        widget.installEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() in self._kinds:
            self._function()
        return False


def call_at(widget: QWidget, function: Callable[[], object], *kinds: QEvent.Type) -> None:
    """Call a function at each event of some kinds, just before the widget handles it."""
    _EventCaller(widget, function, kinds)


def leave_drops_to_window(parent: QWidget) -> None:
    """Disable drops on all widgets inside a widget, so that the window receives dropped files."""
    for widget in parent.findChildren(QWidget):
        widget.setAcceptDrops(False)
