"""The story is on the first screen, and agrees with the other panes."""

import pytest
from gui.user import User
from PySide6.QtCore import QEvent, QPoint, QRect, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.app.story_wiring import story_menu
from occ_gui.scene.control_panel import main_of
from occ_gui.story.verdict_bar import AVERAGES_LESSON
from occ_gui.widgets.state_look import State


def place_in(window: QWidget, part: QWidget) -> QRect:
    """Return the place of a widget's visible part in the window."""
    visible = part.visibleRegion().boundingRect()
    return QRect(part.mapTo(window, visible.topLeft()), visible.size())


def test_controls_verdict_and_rows_are_on_the_first_screen(
    application: Application, qtbot: QtBot
) -> None:
    window, story = application.window, application.story
    window.resize(1280, 800)
    qtbot.waitUntil(lambda: application.is_idle)
    rows = application.controls.main_rows()
    sliders = [rows[name].slider for name in main_of("code")]
    assert len(sliders) == 6
    four = story.rows
    for part in (*sliders, story.verdict, four.light, four.stripes, four.profile, four.code):
        place = place_in(window, part)
        assert place.size() == part.size(), part
        assert window.rect().contains(place)
    assert four.profile.band is not None


def test_the_bar_and_the_decoding_pane_agree(application: Application, user: User) -> None:
    user.change(exposure_time=136e-6, switching_frequency=16e3)
    pane, bar = application.view("decode"), application.story.verdict
    states = set[State]()
    for place in range(pane.decoders.count()):
        pane.decoders.setCurrentIndex(place)
        user.wait_until_idle()
        is_read = pane.verdict.text().startswith("✓")
        assert (bar.state is State.GOOD) == is_read
        states.add(bar.state)
        if is_read:
            assert pane.verdict.text() == f"✓ {bar.title.text()}"
        else:
            assert pane.verdict.text() == "✗ No code read"
            assert bar.title.text().startswith("No code: ")
    assert states >= {State.GOOD, State.BAD}


def test_a_decoder_is_chosen_in_the_story_or_by_its_tab(
    application: Application, user: User
) -> None:
    story, pane = application.story, application.view("decode")
    for name in ("matched", "threshold", "sequence"):
        story.decoder.show_key(name)
        story.decoder.chosen.emit(name)
        user.wait_until_idle()
        assert pane.decoders.tabText(pane.decoders.currentIndex()).startswith(name)
        result = story.rows.result
        assert result.decoder == name
        assert result.code == 718
    pane.decoders.setCurrentIndex(0)
    assert story.decoder.key() == "threshold"


def test_the_whole_picture_opens_by_thumbnail_or_comparison_and_closes_again(
    application: Application, qtbot: QtBot
) -> None:
    story = application.story
    assert not application.view("picture").isVisible()
    qtbot.mouseClick(story.rows.stripes.thumbnail, Qt.MouseButton.LeftButton)
    assert application.view("picture").isVisible()
    assert not story.rows.isVisible()
    assert story.shows_whole_picture
    assert story.verdict.isVisible()
    qtbot.mouseClick(story.whole_picture, Qt.MouseButton.LeftButton)
    assert story.rows.isVisible()
    assert not application.view("picture").isVisible()
    story, before = application.story, application.view("picture").before.checkbox
    before.setChecked(True)
    assert story.shows_whole_picture
    before.setChecked(False)
    assert not story.shows_whole_picture, "the rows were there before"
    story.show_whole_picture(True)
    before.setChecked(True)
    before.setChecked(False)
    assert story.shows_whole_picture, "it was shown before"
    story.show_whole_picture(False)
    story.rows.axis.zoom(0.5, 1500.0)
    application.window.actions_by_name["fit"].trigger()
    assert story.rows.axis.is_following


def test_the_receivers_picture_is_chosen_in_all_panes(application: Application) -> None:
    story, image, profile = (
        application.story,
        application.view("picture"),
        application.view("profile"),
    )
    story.picture_kind.chosen.emit("receiver")
    assert (story.picture_kind.key(), image.picture_kind) == ("receiver", "receiver")
    assert profile.enhanced.isChecked()
    reading = profile.reading
    assert story.rows.profile.levels is reading.signal
    image.choose_picture("camera")
    assert story.picture_kind.key() == "camera"
    assert story.rows.profile.levels is reading.profile
    profile.enhanced.click()
    assert not application.scene_store.store.workspace.is_enhanced


def test_the_mouse_selects_the_column_of_the_readout(
    application: Application, qtbot: QtBot
) -> None:
    rows = application.story.rows
    row = rows.profile
    column = round((rows.axis.first + rows.axis.last) / 2)
    qtbot.mouseMove(row, QPoint(round(row.x_of(column)), row.height() // 2))
    at_mouse = rows.crosshair.mouse_column
    assert at_mouse == pytest.approx(column, abs=1)
    assert application.story.readout.toolTip().startswith(f"column {at_mouse}  ·  ")
    QApplication.sendEvent(row, QEvent(QEvent.Type.Leave))
    assert rows.crosshair.mouse_column is None
    assert application.story.readout.toolTip().startswith(f"column {rows.crosshair.column}  ·  ")


def test_the_equations_explain_the_column_that_the_story_shows(
    application: Application, user: User, qtbot: QtBot
) -> None:
    crosshair = application.story.rows.crosshair
    crosshair.choose(700)
    dock = application.window.docks["equations"]
    application.window.bring_to_front("equations")
    qtbot.waitUntil(lambda: not dock.visibleRegion().isEmpty())
    pane = application.shell.pane("equations").view.exposure
    assert pane.column.value() == 700
    crosshair.choose(640)
    assert pane.column.value() == 640
    pane.column_chosen.emit(655)
    assert crosshair.column == pane.column.value() == 655


def test_the_context_menu_copies_values_and_the_bar_opens_a_lesson(
    application: Application, user: User
) -> None:
    menu = story_menu(application)
    entries = {action.text(): action for action in menu.actions()}
    assert "Meas&ure" in entries
    application.window.actions_by_name["measure"].trigger()
    assert len(application.story.rows.crosshair.cursors.columns) == 2
    entries["Copy the &values at the crosshair"].trigger()
    assert QGuiApplication.clipboard().text().startswith("column ")
    assert user.message.startswith("Copied: column ")
    assert "Copy fi&gure" in entries
    menu.aboutToHide.emit()
    application.story.verdict.lesson_requested.emit(AVERAGES_LESSON)
    pane = application.shell.pane("lessons")
    assert not application.window.docks["lessons"].isHidden()
    assert pane.controller.current.name == AVERAGES_LESSON


def test_a_scene_of_three_colours_says_which_is_read_and_leads_to_all(
    application: Application, user: User
) -> None:
    user.put(occ.load_preset("phone-68us-colour").replace(rows=240), "preset")
    assert application.story.verdict.heading.startswith("Green: code 345 read")
    application.story.verdict.step.click()
    assert not application.window.docks["colour"].isHidden()
    user.choose("&Undo")
    assert application.story.verdict.heading.startswith("Code 718 read")
