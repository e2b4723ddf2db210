"""The scene changes in one place, refuses invalid values, and is undone gesture by gesture."""

from typing import Any

import pytest
from gui.stores import store_of
from pytestqt.qtbot import QtBot

from occ_gui.core.store import NO_GESTURE
from occ_gui.scene.gesture import new_gesture
from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.scene import Scene


@pytest.fixture
def store(qapp: object, small_scene: Scene) -> SceneStore:
    return store_of(small_scene)


@pytest.fixture
def told(store: SceneStore) -> list[Scene]:
    """Record the scenes that the store tells of."""
    scenes: list[Scene] = []
    store.changed.connect(scenes.append)
    return scenes


def test_a_change_is_emitted_with_the_new_scene(
    store: SceneStore, told: list[Scene], small_scene: Scene
) -> None:
    store.change(iso=200.0, distance=2.0)
    assert told == [small_scene.replace(iso=200.0, distance=2.0)]
    assert store.scene == told[0]


@pytest.mark.parametrize(
    ("changes", "preset"),
    [
        ({"iso": 200.0, "distance": 2.0}, "phone-68us"),
        ({"iso": 200.0, "distance": 2.0, "exposure_time": 3e-4}, ""),
    ],
)
def test_a_scene_that_is_changed_a_little_keeps_the_preset_that_it_was(
    store: SceneStore, small_scene: Scene, changes: dict[str, float], preset: str
) -> None:
    store.put(small_scene.replace(code=3), "preset phone-68us", preset="phone-68us")
    store.change(**changes)  # type: ignore[arg-type]  # no gesture is among them
    assert store.store.workspace.preset == preset


@pytest.mark.parametrize(
    ("changes", "named"),
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
    told: list[Scene],
    small_scene: Scene,
    changes: dict[str, Any],
    named: str,
) -> None:
    with qtbot.waitSignal(store.refused) as refusal:
        store.change(**changes)
    (sentence,) = refusal.args or ("",)
    assert named in sentence
    assert sentence.endswith((".", "?"))
    assert store.scene == small_scene
    assert told == []
    assert store.undo_stack.count() == 0


def test_an_equal_scene_is_no_step_and_not_emitted(
    store: SceneStore, told: list[Scene], small_scene: Scene
) -> None:
    store.change(iso=small_scene.camera.iso)
    store.put(small_scene.replace(), "nothing")
    assert told == []
    assert store.undo_stack.count() == 0


def test_changes_of_one_gesture_are_undone_as_one_step(
    store: SceneStore, told: list[Scene], small_scene: Scene
) -> None:
    gesture = new_gesture()
    for iso in (110.0, 120.0, 130.0):
        store.change(gesture, iso=iso)
    assert [scene.camera.iso for scene in told] == [110.0, 120.0, 130.0]
    store.undo_stack.undo()
    assert store.scene == small_scene
    assert not store.undo_stack.canUndo()
    store.undo_stack.redo()
    assert store.scene == small_scene.replace(iso=130.0)


@pytest.mark.parametrize("numbers", [(NO_GESTURE, NO_GESTURE), (new_gesture(), new_gesture())])
def test_different_gestures_are_steps_of_their_own(
    store: SceneStore, small_scene: Scene, numbers: tuple[int, int]
) -> None:
    store.change(numbers[0], iso=110.0)
    store.change(numbers[1], iso=120.0)
    store.undo_stack.undo()
    assert store.scene == small_scene.replace(iso=110.0)
    store.undo_stack.undo()
    assert store.scene == small_scene


def test_a_gesture_that_ends_where_it_began_leaves_no_step(
    store: SceneStore, small_scene: Scene
) -> None:
    gesture = new_gesture()
    store.change(gesture, iso=110.0)
    store.change(gesture, iso=small_scene.camera.iso)
    assert store.scene == small_scene
    assert not store.undo_stack.canUndo()


def test_a_gesture_goes_on_after_passing_where_it_began(
    store: SceneStore, small_scene: Scene
) -> None:
    gesture = new_gesture()
    for iso in (110.0, small_scene.camera.iso, 90.0):
        store.change(gesture, iso=iso)
    assert store.scene == small_scene.replace(iso=90.0)
    store.undo_stack.undo()
    assert store.scene == small_scene


def test_undo_and_redo_give_exactly_the_same_scenes(
    store: SceneStore, told: list[Scene], small_scene: Scene
) -> None:
    store.change(exposure_time=1 / 3 * 1e-4)
    store.put(Scene(), "opening of a file")
    store.change(code=3, averaging="light")
    forth = [small_scene, *told]
    told.clear()
    for _ in range(3):
        store.undo_stack.undo()
    assert told == forth[-2::-1]
    told.clear()
    for _ in range(3):
        store.undo_stack.redo()
    assert told == forth[1:]


def test_a_change_after_undo_forgets_what_was_undone(store: SceneStore, small_scene: Scene) -> None:
    store.change(iso=110.0)
    store.undo_stack.undo()
    store.change(iso=120.0)
    assert not store.undo_stack.canRedo()
    store.undo_stack.undo()
    assert store.scene == small_scene


def test_the_undo_menu_names_the_step(store: SceneStore) -> None:
    store.change(switching_frequency=5e3)
    assert store.undo_stack.undoText() == "change of switching frequency"
    store.put(Scene(), "preset phone-136us")
    assert store.undo_stack.undoText() == "preset phone-136us"


def test_gestures_have_numbers_that_qt_can_merge_by() -> None:
    numbers = [new_gesture() for _ in range(3)]
    assert len(set(numbers)) == 3
    assert NO_GESTURE not in numbers
    assert all(0 <= number < 2**31 for number in numbers)


def test_effects_forced_by_hand_are_undone_and_redone(
    store: SceneStore, told: list[Scene], small_scene: Scene
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
    assert "JPEG off by hand" in store.undo_stack.undoText()
    assert (told, store.scene) == ([], small_scene)


def test_one_step_changes_scene_and_forced_effects_together(
    store: SceneStore, small_scene: Scene
) -> None:
    store.force("jpeg", False)
    states: list[tuple[Scene, dict[str, bool]]] = []
    for source in (store, store.settings):
        source.changed.connect(
            lambda _: states.append((store.scene, dict(store.settings.settings.force)))
        )
    other = small_scene.replace(iso=200.0)
    store.put(other, "another scene", force={})
    store.undo_stack.undo()
    assert states == [(other, {})] * 2 + [(small_scene, {"jpeg": False})] * 2


def test_releasing_all_effects_is_one_step(store: SceneStore) -> None:
    store.force("jpeg", False)
    store.force("vignetting", True)
    store.release_effects()
    assert store.settings.settings.force == {}
    store.undo_stack.undo()
    assert store.settings.settings.force == {"jpeg": False, "vignetting": True}


def test_a_change_of_the_scene_keeps_the_forced_effects(store: SceneStore) -> None:
    store.force("jpeg", False)
    gesture = new_gesture()
    store.change(gesture, iso=200.0)
    store.change(gesture, iso=300.0)
    assert store.settings.settings.force == {"jpeg": False}
    store.undo_stack.undo()
    assert store.settings.settings.force == {"jpeg": False}
