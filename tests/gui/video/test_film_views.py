"""Views of a film: what is read is shown in order, and a recording is entered as users write it."""

import pytest
from gui.kinds import collect, show_widget
from PySide6.QtCore import Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.video.film_reading import FilmReading
from occ_gui.video.recording_form import RecordingForm
from occ_gui.video.video_view import DataView, VideoView
from occ_model.results.fact import Fact
from occ_model.scene.scene import Scene


@pytest.fixture
def view(qtbot: QtBot) -> DataView:
    return show_widget(qtbot, DataView())


def reading(text: str = "", *figures: str, sentences: tuple[str, ...] = ()) -> FilmReading:
    shown = tuple(Fact(name, name, f"{name} 1", meaning=f"What {name} is.") for name in figures)
    return FilmReading(text=text, answer="It is read.", facts=shown, sentences=sentences)


def test_text_that_grows_keeps_what_is_selected_and_is_followed_where_its_end_is_in_view(
    view: DataView,
) -> None:
    view.show_reading(reading("HEL"))
    cursor = view.text.textCursor()
    cursor.setPosition(0)
    cursor.setPosition(2, QTextCursor.MoveMode.KeepAnchor)
    view.text.setTextCursor(cursor)
    view.show_reading(reading("HELLO"))
    assert view.text.toPlainText() == "HELLO"
    assert view.text.textCursor().selectedText() == "HE"
    view.show_reading(reading("J.LLO"))
    assert view.text.toPlainText() == "J.LLO"
    text = "\n".join(map(str, range(200)))
    view.show_reading(reading(text))
    bar = view.text.verticalScrollBar()
    bar.setValue(bar.maximum())
    view.show_reading(reading(text := text + "\nmore" * 50))
    assert bar.value() == bar.maximum()
    bar.setValue(7)
    view.show_reading(reading(text + "\nmore" * 50))
    assert bar.value() == 7


def test_facts_unfold_in_order_beside_the_remarks(view: DataView, qtbot: QtBot) -> None:
    def shown() -> list[str]:
        return [name.text() for name, value in view.rows if value.isVisible()]

    view.show_reading(reading("", "b", "d"))
    assert view.answer.line.text() == "It is read."
    assert shown() == []
    view.answer.more.click()
    view.show_reading(reading("", "a", "b", "c", "d"))
    assert shown() == list("abcd")

    def check() -> None:
        tops = [value.y() for _, value in view.rows]
        assert tops == sorted(set(tops))

    qtbot.waitUntil(check)
    _, value = view.rows[2]
    assert (value.text(), value.accessibleName(), value.toolTip()) == ("c 1", "c", "What c is.")
    view.show_reading(reading("", "d", "a"))
    assert shown() == ["d", "a"]
    view.show_reading(reading(sentences=("One.", "Two.")))
    assert view.sentences.text() == "One.\nTwo."
    view.show_reading(reading())
    assert not view.sentences.isVisible()


@pytest.fixture
def form(qtbot: QtBot) -> RecordingForm:
    return show_widget(qtbot, RecordingForm())


def enter(qtbot: QtBot, form: RecordingForm, name: str, text: str) -> None:
    form.fields[name].selectAll()
    qtbot.keyClicks(form.fields[name], text)
    qtbot.keyClick(form.fields[name], Qt.Key.Key_Return)


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


@pytest.mark.parametrize("bayer", ["none", "rggb"])
def test_gap_and_size_are_stated_or_why_not(
    form: RecordingForm, film_scene: Scene, bayer: str
) -> None:
    form.show_frames(2)
    film_scene = film_scene.replace(bayer=bayer, averaging="light")
    form.show_scene(film_scene)  # 1600 columns of 15 us each: 24 ms of 33.3 ms
    gap, size = form.gap.text().splitlines()
    assert gap == "Between two frames, no column is read out for 9.333 ms, 28.0 % of a frame."
    pixels = sum(frame.image.nbytes for frame in occ.render_video(film_scene, 2).frames())
    stated = float(size.split(" is ")[1].split(" kB")[0])
    assert stated == pytest.approx(pixels / 1e3, rel=1e-3)
    form.show_recording(occ.Recording(frame_rate=60.0))
    form.show_scene(film_scene)
    assert "Reading out 1600 columns" in form.gap.text()


def test_the_pages_change_neither_the_place_of_their_tabs_nor_the_pictures(qtbot: QtBot) -> None:
    view = show_widget(qtbot, VideoView(), 700, 520)
    heights = set()
    for page in range(view.pages.count()):
        view.pages.setCurrentIndex(page)
        QApplication.processEvents()
        heights.add(view.pictures.height())
    assert len(heights) == 1
