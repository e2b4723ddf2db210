"""Two cursors measure columns, time, levels and chips between them."""

import pytest
from gui.kinds import not_none, show_widget
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.story.column_values import measure
from occ_gui.story.story_view import StoryView


@pytest.fixture
def story(qtbot: QtBot, snapshot: Snapshot) -> StoryView:
    """Show the story of a scene, and measure in it."""
    story = show_widget(qtbot, StoryView(QWidget()), 900, 700)
    story.show_picture(Picture.of(snapshot.frame, "camera", snapshot.request))
    story.show_reading(snapshot)
    QApplication.processEvents()
    story.switch_measuring(True)
    return story


def test_the_difference_is_that_of_the_model(story: StoryView, snapshot: Snapshot) -> None:
    rows, scene = story.rows, snapshot.scene
    cursors = rows.crosshair.cursors
    cursors.move(0, 100.0, rows.crosshair.columns)
    cursors.move(1, 225.0, rows.crosshair.columns)
    found = not_none(measure(cursors, scene, rows.profile.levels))
    assert found.columns == 125.0
    assert found.time == pytest.approx(125 * scene.camera.readout_time)
    assert found.chips == pytest.approx(found.time * scene.transmitter.switching_frequency)
    assert rows.profile.levels is not None
    assert found.levels == pytest.approx(rows.profile.levels[225] - rows.profile.levels[100])
    assert story.measured.text().startswith("1 to 2: 125.0 columns  ·  1 ms")
    assert "as a period 1 kHz" in story.measured.toolTip()


def test_a_cursor_is_dragged_in_any_row_and_stays_in_the_picture(
    story: StoryView, qtbot: QtBot
) -> None:
    rows = story.rows
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
    story.switch_measuring(False)
    assert story.rows.crosshair.cursors.columns == []
    assert not story.measured.isVisible()
