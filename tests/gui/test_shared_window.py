"""A window is lent to another test only where that finds it as the first did."""

from collections.abc import Callable
from pathlib import Path

from gui.shared_window import SharedWindow
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.values.modes import MODES
from occ_model.scene.scene import Scene

Change = Callable[[Application], object]

UNDONE: tuple[Change, ...] = (
    lambda at: at.settings.set_tolerance(2.0),
    lambda at: at.window.modes.switch("photo"),
    lambda at: at.controls.show_problem("No.", ("iso",)),
    lambda at: at.photos.list_files([Path("a.png"), Path("b.png")]),
)

LASTING: Change = lambda at: at.story.verdict.setToolTip("something")  # noqa: E731


def is_lent_again(shared: SharedWindow, qtbot: QtBot, scene: Scene, *changes: Change) -> bool:
    with shared.lent(qtbot, scene) as first:
        for change in changes:
            change(first)
    if not shared.is_kept:
        return False
    with shared.lent(qtbot, scene) as second:
        assert second.scene_store.scene == scene
        assert not second.scene_store.undo_stack.canUndo()
        assert second.settings.settings == FIRST_SETTINGS
        assert second.window.modes.mode == next(iter(MODES))
        assert second.window.isVisible()
        assert second.window.statusBar().currentMessage() == ""
        return second is first


def test_a_window_is_lent_again_as_it_was_where_it_can_be_put_back_and_not_where_it_stays_changed(
    kept_window: SharedWindow, qtbot: QtBot, small_scene: Scene
) -> None:
    assert is_lent_again(kept_window, qtbot, small_scene, *UNDONE)
    assert not is_lent_again(kept_window, qtbot, small_scene, LASTING)
