"""The controls of one parameter show its value and emit what the user enters."""

import pytest
from gui.scene.told import Told
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from occ_gui.scene.parameter_rows import (
    ChoiceRow,
    CountRow,
    OpenChoiceRow,
    PatternRow,
    QuantityRow,
    explain,
)
from occ_model.scene.parameter_kinds import (
    ChipPattern,
    Choice,
    Count,
    OpenChoice,
    ParameterValue,
    Payload,
    Quantity,
)
from occ_model.scene.parameters import PARAMETERS

KINDS = {
    Quantity: QuantityRow,
    Count: CountRow,
    Choice: ChoiceRow,
    OpenChoice: OpenChoiceRow,
    ChipPattern: PatternRow,
    Payload: PatternRow,
}


@pytest.mark.parametrize("name", PARAMETERS)
def test_every_kind_of_declaration_has_its_kind_of_row(qtbot: QtBot, name: str) -> None:
    row = Told(name, qtbot).row
    assert row.name == name
    assert type(row) is KINDS[type(PARAMETERS[name])]


@pytest.mark.parametrize("name", PARAMETERS)
def test_showing_a_value_tells_nothing(qtbot: QtBot, name: str) -> None:
    told = Told(name, qtbot)
    declared = PARAMETERS[name]
    others: dict[str, ParameterValue] = {
        "pattern": "0110",
        "preamble": "0110",
        "payload": "text:A",
        "line_code": "4b6b",
        "framing": "raw",
        "error_correction": "reed-solomon",
        "averaging": "light",
        "enhancement": "none",
        "band_reading": "literal",
    }
    value = others.get(name, 3 if isinstance(declared, Count) else 0.5)
    told.row.show_value(value)
    told.row.show_value(declared.default)
    assert told.edits == []
    assert told.refused == []


def test_a_whole_number_is_emitted_when_its_typing_ends_and_quick_steps_are_one_gesture(
    qtbot: QtBot,
) -> None:
    told = Told("bits", qtbot)
    declared = PARAMETERS["bits"]
    assert isinstance(declared, Count)
    assert (told.row.field.minimum(), told.row.field.maximum()) == (declared.low, declared.high)
    told.row.show_value(8)
    told.row.field.selectAll()
    qtbot.keyClicks(told.row.field, "12")
    assert told.edits == []
    qtbot.keyClick(told.row.field, Qt.Key.Key_Return)
    assert told.values == [12]
    told.row.show_value(8)
    for _ in range(3):
        qtbot.keyClick(told.row.field, Qt.Key.Key_Up)
    assert told.values[1:] == [9, 10, 11]
    assert len({gesture for _, _, gesture in told.edits[1:]}) == 1


def test_a_choice_is_emitted_by_its_word(qtbot: QtBot) -> None:
    told = Told("averaging", qtbot)
    words = [told.row.field.itemText(place) for place in range(told.row.field.count())]
    assert words == ["pixel-value", "light"]
    qtbot.keyClick(told.row.field, Qt.Key.Key_Down)
    assert told.values == ["light"]


def test_a_pattern_is_sent_without_spaces_rubbish_refused_and_an_equal_one_no_change(
    qtbot: QtBot,
) -> None:
    told = Told("pattern", qtbot)
    qtbot.keyClicks(told.row.field, "0101 0011")
    qtbot.keyClick(told.row.field, Qt.Key.Key_Return)
    assert told.values == ["01010011"]
    told.row.show_value("01010011")
    qtbot.keyClicks(told.row.field, "2")
    qtbot.keyClick(told.row.field, Qt.Key.Key_Return)
    assert told.values == ["01010011"]
    (sentence,) = told.refused
    assert sentence.startswith("Raw chip pattern cannot be '010100112'")
    told.row.end_refusal()  # another parameter was changed
    assert told.row.field.text() == "010100112"
    assert told.row.notice.text()
    told.row.show_value("01")
    assert (told.row.field.text(), told.row.notice.text()) == ("01", "")
    told.row.show_value("0101")
    told.row.field.clear()
    qtbot.keyClicks(told.row.field, "01 01")
    qtbot.keyClick(told.row.field, Qt.Key.Key_Return)
    assert told.values == ["01010011"]
    assert told.row.field.text() == "0101"


@pytest.mark.parametrize("name", PARAMETERS)
def test_a_tooltip_tells_meaning_symbol_and_allowed_range(name: str) -> None:
    declared = PARAMETERS[name]
    text = explain(declared)
    for part in (declared.label, declared.symbol, declared.meaning, declared.allowed):
        assert part in text
