"""The scene changes in one place, refuses invalid values, and is undone gesture by gesture."""

from typing import Any

import pytest
from gui.kinds import collect
from gui.stores import store_of
from pytestqt.qtbot import QtBot

from occ_gui.core.store import NO_GESTURE
from occ_gui.scene import scene_store
from occ_gui.scene.scene_store import Gestures, SceneStore, new_gesture
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@pytest.fixture
def store(qapp: object, small_scene: Scene) -> SceneStore:
    return store_of(small_scene)


@pytest.fixture
def told(store: SceneStore) -> list[Scene]:
    return collect(store.changed)


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


def test_a_gesture_that_ends_where_it_began_leaves_no_step_and_goes_on_after(
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


def test_the_undo_menu_names_the_step(store: SceneStore) -> None:
    store.change(switching_frequency=5e3)
    assert store.undo_stack.undoText() == "change of switching frequency"
    store.put(Scene(), "preset phone-136us")
    assert store.undo_stack.undoText() == "preset phone-136us"


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
    held = gestures.of_change(held=True)
    qtbot.wait(10)
    last = gestures.of_change()
    assert held == first
    assert last != first


def test_a_gesture_that_has_ended_takes_nothing_more() -> None:
    gestures = Gestures()
    first = gestures.of_change()
    gestures.end()
    assert gestures.of_change(held=True) != first


class Told:
    def __init__(self) -> None:
        self.scenes = store_of()
        self.store = self.scenes.settings
        self.changes: list[SimulationSettings] = []
        self.refusals: list[str] = []
        self.store.changed.connect(self.changes.append)
        self.store.refused.connect(self.refusals.append)

    def switch(self, force: dict[str, bool]) -> None:
        self.scenes.put(self.scenes.scene, "switch", force=force)


@pytest.fixture
def heard() -> Told:
    return Told()


def test_noise_is_reused_at_first_and_a_setting_that_holds_already_is_not_emitted(
    heard: Told,
) -> None:
    assert heard.store.settings == SimulationSettings(noise="reused")
    heard.store.set_tolerance(heard.store.settings.tolerance)
    heard.store.set_observable("image")
    heard.store.set_noise("reused")
    heard.switch({})
    assert heard.changes == []


def test_each_change_is_emitted_once_and_leaves_the_rest(heard: Told) -> None:
    heard.store.set_tolerance(2.0)
    heard.store.set_observable("profile")
    heard.store.set_noise("exact")
    heard.switch({"jpeg": True})
    heard.switch({"jpeg": True, "flicker": False})
    heard.switch({"flicker": False})
    assert heard.store.settings == SimulationSettings(2.0, "profile", {"flicker": False}, "exact")
    assert heard.changes[-1] == heard.store.settings
    assert len(heard.changes) == 6


@pytest.mark.parametrize("tolerance", [-1.0, float("nan")])
def test_a_tolerance_that_cannot_be_is_refused_with_a_sentence(
    heard: Told, tolerance: float
) -> None:
    heard.store.set_tolerance(tolerance)
    (sentence,) = heard.refusals
    assert sentence.startswith("Tolerance cannot be ")
    assert sentence.endswith(".")
    assert heard.changes == []
