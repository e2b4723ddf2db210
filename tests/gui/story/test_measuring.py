"""Two cursors measure columns, time, levels and chips between them."""

import pytest
from gui.user import User
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.app.story_wiring import story_menu
from occ_gui.story.measure_cursors import measure


@pytest.fixture
def measuring(application: Application, user: User) -> Application:
    user.wait_until_idle()
    application.window.actions_by_name["measure"].trigger()
    return application


def test_the_difference_is_that_of_the_model(measuring: Application) -> None:
    rows, scene = measuring.story.rows, measuring.store.scene
    cursors = rows.crosshair.cursors
    cursors.move(0, 100.0, rows.crosshair.columns)
    cursors.move(1, 225.0, rows.crosshair.columns)
    found = measure(cursors, scene, rows.profile.levels)
    assert found is not None
    assert found.columns == 125.0
    assert found.time == pytest.approx(125 * scene.camera.readout_time)
    assert found.chips == pytest.approx(found.time * scene.transmitter.switching_frequency)
    assert rows.profile.levels is not None
    assert found.levels == pytest.approx(rows.profile.levels[225] - rows.profile.levels[100])
    assert measuring.story.measured.text().startswith("1 to 2: 125.0 columns  ·  1 ms")
    assert "as a period 1 kHz" in measuring.story.measured.toolTip()


def test_a_cursor_is_dragged_in_any_row_and_stays_in_the_picture(
    measuring: Application, qtbot: QtBot
) -> None:
    rows = measuring.story.rows
    row, cursors = rows.profile, rows.crosshair.cursors
    first, chosen = cursors.columns[0], rows.crosshair.column
    start = QPoint(round(row.x_of(first)), 20)
    qtbot.mousePress(row, Qt.MouseButton.LeftButton, pos=start)
    qtbot.mouseMove(row, start + QPoint(40, 0))
    qtbot.mouseRelease(row, Qt.MouseButton.LeftButton, pos=start + QPoint(40, 0))
    assert cursors.columns[0] == pytest.approx(row.column_at(start.x() + 40))
    assert cursors.columns[0] > first
    assert rows.crosshair.column == chosen
    cursors.move(0, -50.0, rows.crosshair.columns)
    assert cursors.columns[0] == 0.0


def test_without_measuring_there_are_no_cursors(measuring: Application) -> None:
    measuring.window.actions_by_name["measure"].trigger()
    assert measuring.story.rows.crosshair.cursors.columns == []
    assert not measuring.story.measured.isVisible()


def test_the_context_menu_copies_the_values_at_the_crosshair(
    application: Application, user: User
) -> None:
    user.wait_until_idle()
    entries = {action.text(): action for action in story_menu(application).actions()}
    entries["Copy the &values at the crosshair"].trigger()
    assert QGuiApplication.clipboard().text().startswith("column ")
    assert user.message.startswith("Copied: column ")
    assert "Meas&ure" in entries
    assert "Copy fi&gure" in entries
