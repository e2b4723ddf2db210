"""A number with its unit is read as people write it, and keeps every digit."""

import pytest
from gui.kinds import add_widget, collect
from gui.scene.told import QUANTITIES
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractSpinBox
from pytestqt.qtbot import QtBot

from occ_gui.scene.number_edits import CountEdit, QuantityEdit
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS, count, quantity


class Field:
    """A field on the screen, what it told, and a user who types."""

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


@pytest.mark.parametrize(
    ("name", "text", "value", "shown"),
    [
        ("switching_frequency", "10 kHz", 10e3, "10 kHz"),
        ("exposure_time", "136us", 136e-6, "136 µs"),
        ("exposure_time", "1/8000 s", 1 / 8000, "125 µs"),
        ("distance", "60 cm", 0.6, "0.6 m"),
        ("iso", " 400 ", 400.0, "400"),
    ],
)
def test_what_people_write_is_read_to_the_exact_si_value(
    qtbot: QtBot, name: str, text: str, value: float, shown: str
) -> None:
    field = Field(name, qtbot)
    field.enter(text)
    assert field.edited == [value]
    assert field.refused == []
    assert field.edit.value() == value
    assert field.edit.text() == shown


@pytest.mark.parametrize(
    ("name", "before", "text", "value"),
    [
        ("switching_frequency", 10e3, "14", 14e3),
        ("exposure_time", 2e-3, "1", 1e-3),
        ("distance", 1.2, "2", 2.0),
    ],
)
def test_a_plain_number_is_read_in_the_unit_that_is_shown(
    qtbot: QtBot, name: str, before: float, text: str, value: float
) -> None:
    field = Field(name, qtbot)
    field.edit.set_value(before)
    field.enter(text)
    assert field.edited == [value]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("exposure_time", "soon"),
        ("exposure_time", ""),
        ("exposure_time", "10 kHz"),
        ("distance", "1e999"),
        ("reflectance", "1.5"),
    ],
)
def test_an_impossible_value_is_refused_and_the_last_restored(
    qtbot: QtBot, name: str, text: str
) -> None:
    field = Field(name, qtbot)
    before, shown = field.edit.value(), field.edit.text()
    field.enter(text)
    (sentence,) = field.refused
    assert sentence.startswith(f"{quantity(name).label} cannot be ")
    assert "; allowed: " in sentence
    assert field.edited == []
    assert (field.edit.value(), field.edit.text()) == (before, shown)


@pytest.mark.parametrize("declared", QUANTITIES, ids=lambda declared: declared.name)
def test_leaving_an_untouched_field_emits_and_rounds_nothing(
    qtbot: QtBot, declared: Quantity
) -> None:
    field = Field(declared.name, qtbot)
    third = declared.slider[0] + (declared.slider[1] - declared.slider[0]) / 3
    field.edit.set_value(third)
    field.press(Qt.Key.Key_Return)
    field.edit.editingFinished.emit()
    assert field.edited == []
    assert field.edit.value() == third


def test_showing_a_value_emits_nothing_and_drops_typed_text_and_a_refusal_is_emitted_once(
    qtbot: QtBot,
) -> None:
    field = Field("exposure_time", qtbot)
    field.type("99")
    field.edit.set_value(68e-6)
    field.press(Qt.Key.Key_Return)
    assert field.edit.text() == "68 µs"
    assert field.edited == field.refused == []
    field.enter("soon")
    field.edit.editingFinished.emit()  # as leaving the field does
    assert len(field.refused) == 1


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


@pytest.mark.parametrize("declared", QUANTITIES, ids=lambda declared: declared.name)
def test_steps_end_where_the_slider_ends(qtbot: QtBot, declared: Quantity) -> None:
    field = Field(declared.name, qtbot)
    low, high = declared.slider
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


def test_the_field_is_wide_enough_for_every_value_a_slider_shows(qtbot: QtBot) -> None:
    for declared in QUANTITIES:
        field = Field(declared.name, qtbot).edit
        field.resize(field.minimumSizeHint())
        room = field.lineEdit().width() - field.lineEdit().textMargins().left() - 6
        for step in range(0, 1001, 7):
            text = declared.format(declared.at(step / 1000))
            assert field.fontMetrics().horizontalAdvance(text) <= room, text


@pytest.mark.parametrize(
    ("name", "value", "number"),
    [
        ("switching_frequency", 10.07e3, "10.07"),
        ("yaw", -0.5235987755982988, "-30"),
        ("iso", 1250.0, "1250"),
    ],
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


def test_a_number_typed_over_a_double_clicked_one_replaces_its_decimals(qtbot: QtBot) -> None:
    field = Field("switching_frequency", qtbot)
    field.edit.set_value(14.07e3)
    line = field.edit.lineEdit()
    line.setCursorPosition(1)
    qtbot.mouseDClick(line, Qt.MouseButton.LeftButton, pos=line.cursorRect().center())
    qtbot.keyClicks(line, "20")
    field.press(Qt.Key.Key_Return)
    assert field.edit.value() == 20e3


def test_a_bare_number_that_hardly_means_the_unit_shown_is_asked_for_its_unit(qtbot: QtBot) -> None:
    field = Field("switching_frequency", qtbot)
    field.enter("10 kHz")
    field.enter("20000")
    (sentence,) = field.refused
    assert "20 MHz in the unit shown and 20 kHz in Hz" in sentence
    assert sentence.endswith("written with its unit.")
    assert field.edited == [10e3]
    field.enter("20")
    field.enter("20 MHz")  # beyond the slider, and said so
    assert field.edited == [10e3, 20e3, 20e6]


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
