"""The rows of the story with the results of a small scene."""

import pytest
from gui.kinds import SnapshotOf, show_widget
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.simulation.snapshot import Picture, Snapshot
from occ_gui.story.story_rows import StoryRows


@pytest.fixture
def snapshot(bare_snapshot_of: SnapshotOf) -> Snapshot:
    return bare_snapshot_of()


@pytest.fixture
def rows(qtbot: QtBot, snapshot: Snapshot) -> StoryRows:
    rows = show_widget(qtbot, StoryRows(), 900, 620)
    rows.show_picture(Picture(snapshot.frame, snapshot.request))
    rows.show_reading(snapshot)
    QApplication.processEvents()
    return rows
