"""The controls of one parameter show its value and emit what the user enters."""

import math
from pathlib import Path
from typing import Any

import pytest
from gui.mouse import turn_wheel_at
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from occ_gui.scene.parameter_rows import row_for
from occ_model.scene.parameter_kinds import Count
from occ_model.scene.parameters import PARAMETERS, quantity


class RowTrial:
    """A row with a record of its signals."""

    def __init__(self, name: str, qtbot: QtBot) -> None:
        self.row: Any = row_for(PARAMETERS[name])
        self.edits: list[tuple[str, Any, int]] = []
        self.refused: list[str] = []
        self.row.edited.connect(lambda *edit: self.edits.append(edit))
        self.row.refused.connect(self.refused.append)
        qtbot.addWidget(self.row)
        self.row.show()

    @property
    def values(self) -> list[Any]:
        return [value for _, value, _ in self.edits]

    @property
    def gestures(self) -> set[int]:
        return {gesture for _, _, gesture in self.edits}


def test_a_whole_number_is_emitted_when_its_typing_ends_and_quick_steps_are_one_gesture(
    qtbot: QtBot,
) -> None:
    trial = RowTrial("bits", qtbot)
    declared = PARAMETERS["bits"]
    assert isinstance(declared, Count)
    assert (trial.row.field.minimum(), trial.row.field.maximum()) == (
        declared.low,
        declared.high,
    )
    trial.row.show_value(8)
    trial.row.field.selectAll()
    qtbot.keyClicks(trial.row.field, "12")
    assert trial.edits == []
    qtbot.keyClick(trial.row.field, Qt.Key.Key_Return)
    assert trial.values == [12]
    trial.row.show_value(8)
    for _ in range(3):
        qtbot.keyClick(trial.row.field, Qt.Key.Key_Up)
    assert trial.values[1:] == [9, 10, 11]
    assert len({gesture for _, _, gesture in trial.edits[1:]}) == 1


def test_a_choice_is_emitted_by_its_word(qtbot: QtBot) -> None:
    trial = RowTrial("averaging", qtbot)
    words = [trial.row.field.itemText(place) for place in range(trial.row.field.count())]
    assert words == ["pixel-value", "light"]
    qtbot.keyClick(trial.row.field, Qt.Key.Key_Down)
    assert trial.values == ["light"]


def test_a_pattern_is_sent_without_spaces_or_refused_and_an_equal_one_is_no_change(
    qtbot: QtBot,
) -> None:
    trial = RowTrial("pattern", qtbot)
    qtbot.keyClicks(trial.row.field, "0101 0011")
    qtbot.keyClick(trial.row.field, Qt.Key.Key_Return)
    assert trial.values == ["01010011"]
    trial.row.show_value("01010011")
    qtbot.keyClicks(trial.row.field, "2")
    qtbot.keyClick(trial.row.field, Qt.Key.Key_Return)
    assert trial.values == ["01010011"]
    (sentence,) = trial.refused
    assert sentence.startswith("Raw chip pattern cannot be '010100112'")
    trial.row.end_refusal()  # another parameter was changed
    assert trial.row.field.text() == "010100112"
    assert trial.row.notice.text()
    trial.row.show_value("01")
    assert (trial.row.field.text(), trial.row.notice.text()) == ("01", "")
    trial.row.show_value("0101")
    trial.row.field.clear()
    qtbot.keyClicks(trial.row.field, "01 01")
    qtbot.keyClick(trial.row.field, Qt.Key.Key_Return)
    assert trial.values == ["01010011"]
    assert trial.row.field.text() == "0101"


@pytest.mark.parametrize("name", ["exposure_time", "gamma"])
def test_the_slider_ends_at_the_declared_range_and_its_middle_is_their_mean(
    qtbot: QtBot, name: str
) -> None:
    trial, declared = RowTrial(name, qtbot), quantity(name)
    slider = trial.row.slider
    assert slider.pageStep() == slider.maximum() // 20
    for position in (slider.minimum(), slider.maximum(), slider.minimum(), slider.maximum() // 2):
        slider.setValue(position)
    low, high = declared.slider
    mean = math.sqrt(low * high) if declared.scale == "log" else (low + high) / 2
    assert trial.values[-3:-1] == [high, low]
    assert trial.values[-1] == pytest.approx(mean, rel=1e-3, abs=1e-3 * (high - low))
    assert {edit[0] for edit in trial.edits} == {name}


def test_slider_and_field_show_the_same_value_whichever_is_moved(qtbot: QtBot) -> None:
    trial = RowTrial("distance", qtbot)
    row = trial.row
    row.slider.setValue(row.slider.maximum())
    assert row.field.value() == 5.0
    for text in ("20 cm", "0 m"):
        row.field.selectAll()
        qtbot.keyClicks(row.field, text)
        qtbot.keyClick(row.field, Qt.Key.Key_Return)
        assert row.slider.value() == row.slider.minimum()
    assert trial.values == [5.0, 0.2]
    assert row.notice.text()
    row.slider.setValue(300)
    assert row.notice.text() == ""


def test_a_value_beyond_the_slider_is_kept_and_shown(qtbot: QtBot) -> None:
    trial = RowTrial("distance", qtbot)
    row = trial.row
    row.show_value(50.0)
    assert row.slider.value() == row.slider.maximum()
    assert row.field.value() == 50.0
    assert row.field.text() == "50 m"


def test_a_drag_is_a_gesture_and_keys_until_a_pause_are_another(qtbot: QtBot) -> None:
    trial = RowTrial("iso", qtbot)
    slider = trial.row.slider
    for _ in range(2):
        slider.setSliderDown(True)
        for position in (500, 600, 700):
            slider.setValue(position)
        slider.setSliderDown(False)
    assert len(trial.edits) == 6
    assert len(trial.gestures) == 2
    for gestures in (3, 4):
        for _ in range(3):
            qtbot.keyClick(slider, Qt.Key.Key_Right)
        assert len(trial.gestures) == gestures
        trial.row.gestures.end()  # as after a pause
    trial = RowTrial("iso", qtbot)
    trial.row.slider.setSliderDown(True)
    trial.row.slider.setValue(500)
    trial.row.slider.setSliderDown(False)
    for _ in range(2):
        qtbot.keyClick(trial.row.field, Qt.Key.Key_Up)
    assert (len(trial.edits), len(trial.gestures)) == (3, 2)


def test_every_number_typed_is_a_gesture_of_its_own(qtbot: QtBot) -> None:
    trial = RowTrial("iso", qtbot)
    field = trial.row.field
    for text in ("200", "300"):
        qtbot.keyClick(field, Qt.Key.Key_Up)
        field.selectAll()
        qtbot.keyClicks(field, text)
        qtbot.keyClick(field, Qt.Key.Key_Return)
    assert trial.values[1::2] == [200.0, 300.0]
    assert trial.edits[1][2] not in {trial.edits[0][2], trial.edits[3][2]}


def test_the_wheel_scrolls_the_page_until_a_control_is_chosen(qtbot: QtBot) -> None:
    trial = RowTrial("iso", qtbot)
    trial.row.show()
    slider = trial.row.slider

    slider.clearFocus()
    turn_wheel_at(slider, slider.rect().center())
    assert trial.edits == []
    slider.setFocus()
    qtbot.waitUntil(slider.hasFocus)
    turn_wheel_at(slider, slider.rect().center())
    assert len(trial.edits) == 1


def test_a_recorded_waveform_is_chosen_summed_up_and_removed(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trial = RowTrial("waveform_file", qtbot)
    trial.row.show_value("")
    assert not trial.row.remove.isEnabled()
    path = tmp_path / "light.csv"
    path.write_text("s,level\n0,1\n0.5e-3,0.25\n1e-3\n")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    trial.row.open.click()
    assert trial.values == ["0.0,1.0\n0.0005,0.25\n0.001\n"]
    assert trial.row.field.text() == "2 levels in 1 ms"
    path.write_text("s,level\n0,1\n0.5e-3,7\n")
    trial.row.open.click()
    assert trial.values[1:] == []
    assert "level 7" in trial.refused[0]
    assert trial.row.field.text() == "2 levels in 1 ms"
    trial.row.remove.click()
    assert trial.values[1:] == [""]
    assert trial.row.field.text() == ""
    trial.row.field.setText(str(path.with_name("none.csv")))
    trial.row.field.editingFinished.emit()
    assert len(trial.refused) == 2
