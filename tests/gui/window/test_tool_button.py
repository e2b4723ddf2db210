"""A button of the toolbar outlives its menu entry where the window is taken down."""

from PySide6.QtGui import QUndoCommand, QUndoStack
from pytestqt.qtbot import QtBot
from shiboken6 import delete

from occ_gui.window.toolbar.tool_button import ToolButton


def test_a_button_asks_nothing_of_an_entry_that_is_deleted(qtbot: QtBot) -> None:
    stack = QUndoStack()
    undo = stack.createUndoAction(stack)
    stack.push(QUndoCommand("change of ISO speed"))
    button = ToolButton("undo", undo)
    qtbot.addWidget(button)
    assert button.isEnabled()
    with qtbot.captureExceptions() as raised:
        delete(stack)
    assert raised == []
