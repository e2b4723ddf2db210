"""A window is lent to another test only where that finds it as the first did."""

from collections.abc import Callable
from pathlib import Path

import pytest
from gui.shared_window import SharedWindow
from gui.stores import show
from PySide6.QtWidgets import QTabWidget
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.window.modes import MODES
from occ_model.scene.scene import Scene

Change = Callable[[Application], object]

UNDONE: dict[str, Change] = {
    "scene": lambda at: at.store.change(iso=200.0),
    "effect forced": lambda at: at.store.force("vignetting", True),
    "settings": lambda at: at.settings.set_tolerance(2.0),
    "mode": lambda at: at.window.modes.switch("photo"),
    "focus": lambda at: at.controls.preset.setFocus(),
    "region": lambda at: at.view("picture").simulation.box.setRange(xRange=(3, 9), yRange=(3, 9)),
    "overlay": lambda at: at.options.choose_overlay("blend"),
    "picture": lambda at: at.story.show_whole_picture(True),
    "refusal": lambda at: at.controls.show_problem("No.", ("iso",)),
    "decoder": lambda at: at.view("decode").choose_decoder("matched"),
    "brightness": lambda at: at.options.brightness.switch(True),
    "size": lambda at: at.window.resize(1300, 820),
    "pane": lambda at: at.window.docks["compare"].show(),
    "theme": lambda at: at.options.theme.choose("dark"),
    "column": lambda at: at.story.rows.crosshair.choose(7),
    "page of the controls": lambda at: at.controls.findChildren(QTabWidget)[0].setCurrentIndex(1),
    "sentence": lambda at: at.window.say("something"),
    "readout": lambda at: at.window.pointed.set_full_text("something"),
    "measuring": lambda at: at.window.actions_by_name["measure"].trigger(),
    "scene file": lambda at: show(at.store.store, scene_file=Path("some.toml")),
    "several photos": lambda at: at.photo._show_several([Path("a.png"), Path("b.png")]),
}

EVERY_DAY = ("settings", "mode", "refusal", "several photos")

LASTING: dict[str, Change] = {
    "label": lambda at: at.story.verdict.setToolTip("something"),
    "entry": lambda at: at.window.actions_by_name["quit"].setEnabled(False),
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


@pytest.mark.parametrize(
    "change", [pytest.param(c, marks=() if c in EVERY_DAY else pytest.mark.whole) for c in UNDONE]
)
def test_a_window_that_can_be_put_back_is_lent_again_as_it_was(
    kept_window: SharedWindow, qtbot: QtBot, small_scene: Scene, change: str
) -> None:
    assert is_lent_again(kept_window, qtbot, small_scene, UNDONE[change])


@pytest.mark.parametrize("change", LASTING)
def test_a_window_that_stays_changed_is_not_lent_again(
    kept_window: SharedWindow, qtbot: QtBot, small_scene: Scene, change: str
) -> None:
    assert not is_lent_again(kept_window, qtbot, small_scene, LASTING[change])
