"""The pane of the story: its pages, its ranges, and the space that it needs."""

import pytest
from gui.kinds import show_widget
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot
from shiboken6 import delete, isValid

from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.story.story_rows import StoryRows
from occ_gui.story.story_view import StoryView


@pytest.fixture
def view(qtbot: QtBot, snapshot: Snapshot) -> StoryView:
    """Show the pane, with an empty widget for the whole picture."""
    view = show_widget(qtbot, StoryView(QWidget(), ("threshold", "matched")), 900, 640)
    view.show_picture(Picture.of(snapshot.frame, "camera", snapshot.request))
    view.show_reading(snapshot)
    QApplication.processEvents()
    return view


def checked(view: StoryView) -> list[str]:
    return [name for name, button in view.rows.ranges.items() if button.isChecked()]


def test_only_the_page_that_is_shown_needs_space(view: StoryView) -> None:
    rows = view.minimumSizeHint().height()
    view.show_whole_picture(True)
    QApplication.processEvents()
    assert view.minimumSizeHint().height() < rows - view.rows.code.height()
    view.show_whole_picture(False)
    QApplication.processEvents()
    assert view.minimumSizeHint().height() == rows


def test_it_fits_beside_other_panes_of_a_small_window(view: StoryView) -> None:
    least = view.minimumSizeHint()
    assert least.width() <= 460
    assert least.height() <= 400
    view.resize(least)
    QApplication.processEvents()
    assert view.width() == least.width()
    assert view.height() <= 400  # the legend may need lines of its own
    assert not view.grab().isNull()


def test_a_range_is_marked_until_the_columns_are_moved(view: StoryView) -> None:
    assert checked(view) == ["packets"]
    packets = view.rows.axis.span
    view.rows.ranges["panel"].click()
    assert checked(view) == ["panel"]
    assert view.rows.axis.span > 1.5 * packets
    view.rows.axis.zoom(0.5, 1500.0)
    assert checked(view) == []
    view.rows.fit()
    assert checked(view) == ["panel"]
    view.choose_decoder("matched")
    assert view.decoder.key() == "matched"
    assert view.rows.decoded is not None
    assert view.rows.decoded.decoder == "matched"
    assert view.verdict.title.text() == "Code 718 read, all bits right"


def test_the_buttons_of_the_ranges_end_with_the_rows(qapp: QApplication) -> None:
    rows = StoryRows()
    buttons = [*rows.ranges.values()]
    delete(rows)
    assert not any(map(isValid, buttons))
