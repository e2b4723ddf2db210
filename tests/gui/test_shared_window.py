"""A window is lent to another test only where that finds it as the first did."""

from collections.abc import Callable, Iterator

import pytest
from gui.shared_window import SharedWindow
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_model.scene.scene import Scene

Change = Callable[[Application], object]

LASTING: dict[str, Change] = {
    "scene": lambda at: at.store.change(iso=200.0),
    "effect forced": lambda at: at.store.force("vignetting", True),
    "settings": lambda at: at.settings.set_tolerance(2.0),
    "mode": lambda at: at.window.modes.switch("photo"),
    "size": lambda at: at.window.resize(1300, 820),
    "pane": lambda at: at.window.docks["compare"].show(),
    "overlay": lambda at: at.show_mode("blend"),
    "label": lambda at: at.story.verdict.setToolTip("something"),
    "entry": lambda at: at.window.actions_by_name["quit"].setEnabled(False),
    "focus": lambda at: at.controls.preset.setFocus(),
    "region": lambda at: at.image.simulation.box.setRange(xRange=(3, 9), yRange=(3, 9)),
    "closed": lambda at: at.window.close(),
}


@pytest.fixture
def shared() -> Iterator[SharedWindow]:
    shared = SharedWindow()
    yield shared
    shared.close()


def is_lent_again(shared: SharedWindow, qtbot: QtBot, scene: Scene, change: Change) -> bool:
    with shared.lent(qtbot, scene) as first:
        change(first)
    with shared.lent(qtbot, scene) as second:
        assert second.store.scene == scene
        assert second.window.isVisible()
        assert second.window.statusBar().currentMessage() == ""
        return second is first


def test_a_window_that_only_said_something_is_lent_again(
    shared: SharedWindow, qtbot: QtBot, small_scene: Scene
) -> None:
    assert is_lent_again(shared, qtbot, small_scene, lambda at: at.window.say("something"))


@pytest.mark.parametrize("change", LASTING)
def test_a_window_that_stays_changed_is_not_lent_again(
    shared: SharedWindow, qtbot: QtBot, small_scene: Scene, change: str
) -> None:
    assert not is_lent_again(shared, qtbot, small_scene, LASTING[change])
