"""Choose a word of a combo box with the keys, as its user does."""

from typing import Any

from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot


def choose(qtbot: QtBot, control: Any, key: str) -> None:
    control.setFocus()
    qtbot.keyClick(control, Qt.Key.Key_Home)
    for _ in range(control.findData(key)):
        qtbot.keyClick(control, Qt.Key.Key_Down)
    assert control.key() == key
