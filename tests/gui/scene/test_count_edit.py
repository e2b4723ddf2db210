"""A whole number is read as typed, and nothing is made of what is none."""

import pytest
from gui.kinds import add_widget, collect
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from occ_gui.scene.number_edits import CountEdit
from occ_model.scene.parameters import count


@pytest.mark.parametrize(
    ("text", "value"), [("1200", 1200), (" 7 ", 7), ("0x10", 16), ("0b101", 5), ("007", 7)]
)
def test_a_whole_number_is_read_in_any_notation(qtbot: QtBot, text: str, value: int) -> None:
    assert typed(qtbot, text) == (value, [], [value])


@pytest.mark.parametrize("text", ["1,5", "1.5", "1,000", "99999999", "0", "-3", "soon", ""])
def test_what_is_no_allowed_count_is_refused_once(qtbot: QtBot, text: str) -> None:
    value, refused, changes = typed(qtbot, text)
    assert value == 640
    assert len(refused) == 1
    assert changes == []


def typed(qtbot: QtBot, text: str) -> tuple[int, list[str], list[int]]:
    """Type a text over the number 640 and leave the field."""
    field = add_widget(qtbot, CountEdit(count("columns")))
    field.setValue(640)
    changes: list[int] = []
    refused = collect(field.refused)
    field.valueChanged.connect(changes.append)
    field.show()
    field.selectAll()
    qtbot.keyClick(field, Qt.Key.Key_Delete)
    qtbot.keyClicks(field, text)
    qtbot.keyClick(field, Qt.Key.Key_Return)
    field.clearFocus()
    return field.value(), refused, changes
