"""The timeline of a film looks like its stored pictures, in both themes; see test_panes."""

from collections.abc import Callable

import numpy as np
import pytest
from gui.snapshots.drawing import show
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.video.mark_look import MarkLegend
from occ_gui.video.marks import Marks, frame_marks
from occ_gui.video.timeline import Timeline
from occ_gui.window.theme import palette_of


def frames() -> Marks:
    """Give some frames of each state."""
    states = np.array([1] * 9 + [2] * 4 + [3] * 5 + [1] * 6 + [0] * 16, dtype=np.uint8)
    return frame_marks(np.arange(len(states)) / 30.0, states, 1 / 30.0)


def packets(count: int) -> Marks:
    """Give packets from the film's begin to its middle."""
    starts = np.linspace(0.0, 0.7, count, endpoint=False)
    states = np.array([1, 1, 3, 1, 2], dtype=np.uint8)[np.arange(count) % 5]
    return Marks(starts, starts + 0.7 / count, states)


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize(("name", "count"), [("few", 20), ("many", 900)])
def test_the_timeline_looks_as_stored(
    qtbot: QtBot, matches_its_picture: Callable[..., None], theme: str, name: str, count: int
) -> None:
    QApplication.setPalette(palette_of(theme))
    pane, timeline = QWidget(), Timeline()
    layout = QVBoxLayout(pane)
    layout.addWidget(MarkLegend())
    layout.addWidget(timeline)
    show(qtbot, pane, 640, 130)
    timeline.show_frames(frames())
    timeline.show_packets(packets(count))
    timeline.show_index(15)
    matches_its_picture(pane, f"timeline-{name}-{theme}")
