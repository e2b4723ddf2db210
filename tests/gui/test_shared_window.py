"""A window is lent to another test only where that finds it as the first did."""

from collections.abc import Callable
from pathlib import Path

import pytest
from gui.shared_window import SharedWindow
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.window.modes import MODES
from occ_model.scene.scene import Scene

Change = Callable[[Application], object]

UNDONE: tuple[Change, ...] = (
    lambda at: at.settings.set_tolerance(2.0),
    lambda at: at.window.modes.switch("photo"),
    lambda at: at.controls.show_problem("No.", ("iso",)),
    lambda at: at.photo._show_several([Path("a.png"), Path("b.png")]),
)

LASTING: dict[str, Change] = {
    "label": lambda at: at.story.verdict.setToolTip("something"),
    "closed": lambda at: at.window.close(),
}


def is_lent_again(shared: SharedWindow, qtbot: QtBot, scene: Scene, change: Change) -> bool:
    with shared.lent(qtbot, scene) as first:
        change(first)
    if not shared.is_kept:
        return False
    with shared.lent(qtbot, scene) as second:
        assert second.store.scene == scene
        assert not second.store.undo_stack.canUndo()
        assert second.settings.settings == FIRST_SETTINGS
        assert second.window.modes.mode == next(iter(MODES))
        assert second.window.isVisible()
        assert second.window.statusBar().currentMessage() == ""
        return second is first


@pytest.mark.parametrize("change", UNDONE)
def test_a_window_that_can_be_put_back_is_lent_again_as_it_was(
    kept_window: SharedWindow, qtbot: QtBot, small_scene: Scene, change: Change
) -> None:
    assert is_lent_again(kept_window, qtbot, small_scene, change)


@pytest.mark.parametrize("change", LASTING)
def test_a_window_that_stays_changed_is_not_lent_again(
    kept_window: SharedWindow, qtbot: QtBot, small_scene: Scene, change: str
) -> None:
    assert not is_lent_again(kept_window, qtbot, small_scene, LASTING[change])
