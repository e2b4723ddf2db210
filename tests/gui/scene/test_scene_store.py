"""The scene changes in one place, refuses invalid values, and is undone gesture by gesture."""

from typing import Any

import pytest
from gui.kinds import collect
from gui.stores import store_of
from pytestqt.qtbot import QtBot

from occ_gui.scene import scene_store
from occ_gui.scene.scene_store import Gestures, SceneStore, new_gesture
from occ_model.scene.scene import Scene


@pytest.fixture
def store(qapp: object, small_scene: Scene) -> SceneStore:
    return store_of(small_scene)


@pytest.fixture
def scenes(store: SceneStore) -> list[Scene]:
    return collect(store.changed)


def test_panes_of_one_colour_see_the_shown_one(store: SceneStore, small_scene: Scene) -> None:
    assert store.seen == small_scene
    store.change(bayer="rggb", averaging="light", shown_colour="blue")
    assert store.seen == store.scene.colour("blue")
    store.change(averaging="pixel-value")  # refused where it is simulated
    assert store.seen == store.scene


@pytest.mark.parametrize(
    ("changes", "preset"),
    [
        ({"iso": 200.0, "distance": 2.0}, "phone-68us"),
        ({"iso": 200.0, "distance": 2.0, "exposure_time": 3e-4}, ""),
    ],
)
def test_a_scene_that_changes_little_keeps_its_preset(
    store: SceneStore, small_scene: Scene, changes: dict[str, float], preset: str
) -> None:
    store.put(small_scene.replace(code=3), "preset phone-68us", preset="phone-68us")
    store.change(**changes)  # type: ignore[arg-type]  # no gesture is among them
    assert store.store.workspace.preset == preset


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"iso": -1.0}, "ISO speed cannot be -1;"),
        ({"exposure_time": float("nan")}, "Exposure time cannot be nan"),
        ({"bits": 3}, "Refused: Code is 718;"),  # 718 needs more
        ({"iso": 200.0, "averaging": "by guess"}, "Averaging cannot be 'by guess'"),
        ({"shutter": 1.0}, "shutter"),
    ],
)
def test_an_impossible_value_is_refused_and_changes_nothing(
    qtbot: QtBot,
    store: SceneStore,
    scenes: list[Scene],
    small_scene: Scene,
    changes: dict[str, Any],
    words: str,
) -> None:
    with qtbot.waitSignal(store.refused) as refusal:
        store.change(**changes)
    (sentence,) = refusal.args or ("",)
    assert words in sentence
    assert sentence.endswith((".", "?"))
    assert store.scene == small_scene
    assert scenes == []
    assert store.undo_stack.count() == 0


def test_a_gesture_back_at_its_start_leaves_no_step_and_may_continue(
    store: SceneStore, small_scene: Scene
) -> None:
    gesture = new_gesture()
    store.change(gesture, iso=110.0)
    store.change(gesture, iso=small_scene.camera.iso)
    assert store.scene == small_scene
    assert not store.undo_stack.canUndo()
    for iso in (110.0, small_scene.camera.iso, 90.0):
        store.change(gesture, iso=iso)
    assert store.scene == small_scene.replace(iso=90.0)
    store.undo_stack.undo()
    assert store.scene == small_scene


def test_effects_forced_by_hand_are_undone_and_redone(
    store: SceneStore, scenes: list[Scene], small_scene: Scene
) -> None:
    store.force("jpeg", False)
    store.force("vignetting", True)
    store.force("jpeg", None)
    forced = [dict(store.settings.settings.force)]
    for _ in range(3):
        store.undo_stack.undo()
        forced.append(dict(store.settings.settings.force))
    assert forced == [
        {"vignetting": True}, {"jpeg": False, "vignetting": True}, {"jpeg": False}, {}
    ]  # fmt: skip
    store.undo_stack.redo()
    assert store.settings.settings.force == {"jpeg": False}
    assert "JPEG switched off" in store.undo_stack.undoText()
    assert (scenes, store.scene) == ([], small_scene)


def test_one_step_changes_scene_and_forced_effects_together(
    store: SceneStore, small_scene: Scene
) -> None:
    store.force("jpeg", False)
    steps, settings = store.undo_stack.count(), store.settings
    store.put(small_scene.replace(iso=200.0), "another scene", force={})
    assert (store.scene.camera.iso, settings.settings.force) == (200.0, {})
    assert store.undo_stack.count() == steps + 1
    store.undo_stack.undo()
    assert (store.scene, settings.settings.force) == (small_scene, {"jpeg": False})


def test_a_change_of_the_scene_keeps_the_forced_effects_and_releasing_all_is_one_step(
    store: SceneStore,
) -> None:
    store.force("jpeg", False)
    store.force("vignetting", True)
    store.release_effects()
    assert store.settings.settings.force == {}
    store.undo_stack.undo()
    assert store.settings.settings.force == {"jpeg": False, "vignetting": True}
    gesture = new_gesture()
    store.change(gesture, iso=200.0)
    store.change(gesture, iso=300.0)
    assert store.settings.settings.force == {"jpeg": False, "vignetting": True}
    store.undo_stack.undo()
    assert store.settings.settings.force == {"jpeg": False, "vignetting": True}


def test_changes_without_a_pause_are_one_gesture_and_no_others() -> None:
    one, other = Gestures(), Gestures()
    assert one.of_change() == one.of_change() == one.of_change()
    assert len({one.of_change(), other.of_change(), new_gesture()}) == 3


def test_a_pause_ends_a_gesture_unless_it_is_held(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(scene_store, "PAUSE_MS", 1)
    gestures = Gestures()
    first = gestures.of_change()
    qtbot.wait(10)
    held = gestures.of_change(is_held=True)
    qtbot.wait(10)
    last = gestures.of_change()
    assert held == first
    assert last != first
