"""The rows of the story with the results of a small scene."""

from collections.abc import Callable

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.story.story_rows import StoryRows


@pytest.fixture
def snapshot(bare_snapshot_of: Callable[..., Snapshot]) -> Snapshot:
    """Give the results of the small scene without any effect."""
    return bare_snapshot_of()


@pytest.fixture
def rows(qtbot: QtBot, snapshot: Snapshot) -> StoryRows:
    """Show the rows with these results."""
    rows = StoryRows()
    qtbot.addWidget(rows)
    rows.resize(900, 620)
    rows.show()
    rows.show_picture(Picture.of(snapshot.frame, "camera", snapshot.request))
    rows.show_reading(snapshot)
    QApplication.processEvents()
    return rows
