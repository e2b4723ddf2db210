"""The pane of the story: its pages, ranges, scales and cursors, and the space that it needs."""

import pytest
from gui.kinds import SnapshotOf, show_widget
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot
from shiboken6 import delete, isValid

from occ_gui.simulation.snapshot import Picture, Snapshot
from occ_gui.story.column_values import measure
from occ_gui.story.story_rows import StoryRows
from occ_gui.story.story_view import StoryView
from occ_gui.widgets.columns import round_step


@pytest.fixture
def view(qtbot: QtBot, snapshot: Snapshot) -> StoryView:
    """Show the pane, with an empty widget for the whole picture."""
    view = show_widget(qtbot, StoryView(QWidget(), ("threshold", "matched")), 900, 640)
    view.show_picture(Picture(snapshot.frame, snapshot.request))
    view.show_reading(snapshot)
    QApplication.processEvents()
    return view


def checked_ranges(view: StoryView) -> list[str]:
    return [name for name, button in view.rows.ranges.items() if button.isChecked()]


def test_a_range_is_marked_until_the_columns_are_moved(view: StoryView) -> None:
    assert checked_ranges(view) == ["packets"]
    packets = view.rows.axis.span
    view.rows.ranges["panel"].click()
    assert checked_ranges(view) == ["panel"]
    assert view.rows.axis.span > 1.5 * packets
    view.rows.axis.zoom(0.5, 1500.0)
    assert checked_ranges(view) == []
    view.rows.fit()
    assert checked_ranges(view) == ["panel"]
    view.choose_decoder("matched")
    assert view.decoder.key() == "matched"
    assert view.rows.result.decoder == "matched"
    assert view.verdict.heading.startswith("Code 718 read, all bits right")


def test_the_difference_is_that_of_the_model(view: StoryView, snapshot: Snapshot) -> None:
    rows, scene = view.rows, snapshot.scene
    view.switch_measuring(True)
    cursors = rows.crosshair.cursors
    cursors.move(0, 100.0, rows.crosshair.columns)
    cursors.move(1, 225.0, rows.crosshair.columns)
    difference = measure(cursors, snapshot, rows.profile.levels)
    assert difference.columns == 125.0
    assert difference.time == pytest.approx(125 * scene.camera.readout_time)
    chips = difference.time * scene.transmitter.switching_frequency
    assert difference.count == pytest.approx(chips)
    assert difference.unit == "chips"
    levels = rows.profile.levels
    assert difference.levels == pytest.approx(levels[225] - levels[100])
    assert view.measured.text().startswith("1 to 2: 125.0 columns  ·  1 ms")
    assert "as a period 1 kHz" in view.measured.toolTip()


def test_a_cursor_is_dragged_in_any_row_and_stays_in_the_picture(
    view: StoryView, qtbot: QtBot
) -> None:
    rows = view.rows
    view.switch_measuring(True)
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
    view.switch_measuring(False)
    assert view.rows.crosshair.cursors.columns == []
    assert not view.measured.isVisible()


def test_the_buttons_of_the_ranges_end_with_the_rows(qapp: QApplication) -> None:
    rows = StoryRows()
    buttons = [*rows.ranges.values()]
    delete(rows)
    assert not any(map(isValid, buttons))


def test_each_time_is_that_of_its_column(rows: StoryRows, bare_snapshot_of: SnapshotOf) -> None:
    snapshot = bare_snapshot_of(start_time=2.5e-3, readout_time=11e-6)
    rows.show_reading(snapshot)
    assert (rows.time.accessibleName(), rows.columns.accessibleName()) == ("time (µs)", "column")
    ticks = rows.time.list_ticks()
    assert len(ticks) > 3
    for column, text in ticks:
        assert float(text) == pytest.approx(2500.0 + 11.0 * column, abs=1e-6)
        assert rows.axis.first <= column <= rows.axis.last
    for columns in (rows.axis.span, 4.0):  # no part of a column is numbered
        rows.axis.zoom(columns / rows.axis.span, 1500.0)
        assert [float(text) for _, text in rows.columns.list_ticks()] == [
            int(column) for column, _ in rows.columns.list_ticks()
        ]


@pytest.mark.parametrize(("least", "step"), [(0.011, 0.02), (1.0, 1.0), (3.0, 5.0), (51.0, 100.0)])
def test_a_step_is_round_and_no_smaller_than_the_least(least: float, step: float) -> None:
    assert round_step(least) == pytest.approx(step)
