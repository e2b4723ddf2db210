"""Number fields read numbers and units as people write them, and keep every digit."""

import pytest
from gui.kinds import add_widget, collect
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractSpinBox
from pytestqt.qtbot import QtBot

from occ_gui.scene.number_edits import CountEdit, QuantityEdit
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS, count, quantity


class Field:
    """A visible field with a record of its signals, and a user who types."""

    def __init__(self, name: str, qtbot: QtBot) -> None:
        declared = PARAMETERS[name]
        assert isinstance(declared, Quantity)
        self.edit = QuantityEdit(declared)
        self.edited: list[float] = []
        self.refused: list[str] = []
        self.edit.edited.connect(self.edited.append)
        self.edit.refused.connect(self.refused.append)
        self._qtbot = qtbot
        qtbot.addWidget(self.edit)
        self.edit.show()

    def type(self, text: str) -> None:
        self.edit.selectAll()
        self.press(Qt.Key.Key_Delete)
        self._qtbot.keyClicks(self.edit, text)

    def press(self, key: Qt.Key) -> None:
        self._qtbot.keyClick(self.edit, key)

    def enter(self, text: str) -> None:
        self.type(text)
        self.press(Qt.Key.Key_Return)


def test_leaving_an_untouched_field_emits_and_rounds_nothing(qtbot: QtBot) -> None:
    field, third = Field("distance", qtbot), 4 / 3
    field.edit.set_value(third)
    field.press(Qt.Key.Key_Return)
    field.edit.editingFinished.emit()
    assert field.edited == []
    assert field.edit.value() == third


def test_showing_a_value_silently_replaces_typed_text_and_each_refusal_is_emitted_once(
    qtbot: QtBot,
) -> None:
    field = Field("exposure_time", qtbot)
    field.type("99")
    field.edit.set_value(68e-6)
    field.press(Qt.Key.Key_Return)
    assert field.edit.text() == "68 µs"
    assert field.edited == field.refused == []
    for text in ("soon", ""):
        field.enter(text)
        field.edit.editingFinished.emit()  # as when the field is left
        assert field.edit.text() == "68 µs"
    assert len(field.refused) == 2


def test_arrow_keys_step_by_one_fraction_along_the_scale_from_what_was_typed(qtbot: QtBot) -> None:
    log, linear = Field("exposure_time", qtbot), Field("gamma", qtbot)
    log.edit.set_value(1e-4)
    linear.edit.set_value(2.0)
    for field in (log, linear):
        field.press(Qt.Key.Key_Up)
    assert log.edited == [pytest.approx(1e-4 * 200**0.01, rel=1e-3)]
    assert linear.edited == [pytest.approx(2.03)]
    for field in (log, linear):
        field.press(Qt.Key.Key_Down)
    assert log.edit.value() == pytest.approx(1e-4, rel=1e-3)
    assert linear.edit.value() == pytest.approx(2.0)
    linear.type("3")
    linear.press(Qt.Key.Key_Up)
    assert linear.edit.value() == pytest.approx(3.03)


def test_steps_end_where_the_slider_ends(qtbot: QtBot) -> None:
    field = Field("distance", qtbot)
    low, high = quantity("distance").slider
    flags = QAbstractSpinBox.StepEnabledFlag
    for end, key, enabled in (
        (high, Qt.Key.Key_Up, flags.StepDownEnabled),
        (low, Qt.Key.Key_Down, flags.StepUpEnabled),
    ):
        field.edit.set_value(end)
        field.press(key)
        assert field.edit.value() == end
        assert field.edit.stepEnabled() == enabled
    assert field.edited == []


@pytest.mark.parametrize(
    ("name", "value", "number"),
    [("switching_frequency", 10.07e3, "10.07"), ("yaw", -0.5235987755982988, "-30")],
)
def test_a_double_click_selects_the_whole_number_and_a_third_click_all(
    qtbot: QtBot, name: str, value: float, number: str
) -> None:
    field = Field(name, qtbot)
    field.edit.set_value(value)
    line = field.edit.lineEdit()
    line.setCursorPosition(1)
    spot = line.cursorRect().center()
    qtbot.mouseClick(line, Qt.MouseButton.LeftButton, pos=spot)
    qtbot.mouseDClick(line, Qt.MouseButton.LeftButton, pos=spot)
    assert line.selectedText() == number
    qtbot.mouseClick(line, Qt.MouseButton.LeftButton, pos=spot)
    assert line.selectedText() == line.text()


def test_a_bare_number_that_is_unlikely_in_the_unit_shown_needs_a_unit(qtbot: QtBot) -> None:
    field = Field("switching_frequency", qtbot)
    field.enter("10 kHz")
    field.enter("20000")
    (sentence,) = field.refused
    assert "20 MHz in the unit shown and 20 kHz in Hz" in sentence
    assert sentence.endswith("written with its unit.")
    assert field.edited == [10e3]
    field.enter("20")
    field.enter("20 MHz")  # allowed beyond the slider, with its unit
    assert field.edited == [10e3, 20e3, 20e6]


@pytest.mark.parametrize(
    ("text", "value"), [("0x10", 16), ("1.5", None), ("99999999", None), ("", None)]
)
def test_a_whole_number_is_read_in_any_notation_or_refused_once(
    qtbot: QtBot, text: str, value: int | None
) -> None:
    number, refused, changes = type_number(qtbot, text)
    assert number == (640 if value is None else value)
    assert changes == ([] if value is None else [value])
    assert len(refused) == (value is None)


def type_number(qtbot: QtBot, text: str) -> tuple[int, list[str], list[int]]:
    """Replace the number 640 by a text, leave the field; return number, refusals and changes."""
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


def test_a_plain_number_is_read_in_the_unit_that_is_shown(qtbot: QtBot) -> None:
    field = Field("exposure_time", qtbot)
    field.edit.set_value(2e-3)
    field.enter("1")
    assert field.edited == [1e-3]
