"""The story looks like its stored pictures, in both themes; see test_panes for renewing them."""

from collections.abc import Callable
from typing import Any

import pytest
from gui.snapshots.drawing import show
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.story.story_view import StoryView
from occ_gui.window.theme import palette_of

MISREAD: dict[str, Any] = {"exposure_time": 136e-6, "switching_frequency": 16e3}


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize(("name", "changes"), [("read", {}), ("misread", MISREAD)])
def test_the_story_looks_as_stored(
    qtbot: QtBot,
    snapshot_of: Callable[..., Snapshot],
    matches_its_picture: Callable[[QWidget, str], None],
    theme: str,
    name: str,
    changes: dict[str, Any],
) -> None:
    QApplication.setPalette(palette_of(theme))
    view = StoryView(QWidget(), ("threshold", "matched"))
    show(qtbot, view, 820, 560)
    snapshot = snapshot_of(**changes)
    view.show_picture(Picture.of(snapshot.frame, "camera", snapshot.request))
    view.show_reading(snapshot)
    matches_its_picture(view, f"story-{name}-{theme}")
