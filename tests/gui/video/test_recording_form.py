"""Form of the recording: values as people write them, and what the gap between frames is."""

import pytest
from gui.kinds import collect, show_widget
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.video.recording_form import RecordingForm
from occ_model.scene.recording import DECLARED
from occ_model.scene.scene import Scene


@pytest.fixture
def form(qtbot: QtBot) -> RecordingForm:
    return show_widget(qtbot, RecordingForm())


def enter(qtbot: QtBot, form: RecordingForm, name: str, text: str) -> None:
    form.fields[name].selectAll()
    qtbot.keyClicks(form.fields[name], text)
    qtbot.keyClick(form.fields[name], Qt.Key.Key_Return)


def test_each_declared_quantity_has_a_named_field(form: RecordingForm) -> None:
    assert set(form.fields) == {declared.name for declared in DECLARED}
    for declared in DECLARED:
        assert form.fields[declared.name].accessibleName() == declared.label
        assert declared.meaning in form.fields[declared.name].toolTip()


def test_values_are_taken_as_people_write_them_and_refused_out_of_range(
    form: RecordingForm, qtbot: QtBot
) -> None:
    changes: list[None] = []
    form.changed.connect(lambda: changes.append(None))
    enter(qtbot, form, "frame_rate", "120")
    enter(qtbot, form, "frame_jitter", "20 us")
    enter(qtbot, form, "camera_drift", "-50 ppm")
    recording = form.recording
    assert (recording.frame_rate, recording.frame_jitter) == (120.0, pytest.approx(20e-6))
    assert recording.camera_drift == pytest.approx(-50e-6)
    assert len(changes) == 3
    refusals = collect(form.refused)
    enter(qtbot, form, "frame_rate", "-3")
    assert form.recording == recording
    assert len(refusals) == 1
    assert "Frame rate cannot be " in refusals[0]


def test_the_gap_is_stated_or_why_there_is_none(form: RecordingForm, film_scene: Scene) -> None:
    form.show_scene(film_scene)  # 1600 columns of 15 us each: 24 ms of 33.3 ms
    assert (
        form.gap.text() == "Between two frames no column is read for 9.333 ms, 28.0 % of a frame."
    )
    form.show_recording(occ.Recording(frame_rate=60.0))
    form.show_scene(film_scene)
    assert "Reading out 1600 columns" in form.gap.text()
