"""The workspace changes in one place; undoing a step keeps what was set since."""

from dataclasses import replace

import pytest
from gui.kinds import collect

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_model.scene.scene import Scene


@pytest.fixture
def store(qapp: object) -> Store:
    return Store(Workspace(Scene()))


def put_iso(store: Store, iso: float, gesture: int = -1) -> None:
    scene = store.workspace.scene.replace(iso=iso)
    store.put(replace(store.workspace, scene=scene), f"iso {iso:g}", gesture)


def iso(store: Store) -> float:
    return store.workspace.scene.camera.iso


def test_a_selection_announces_only_changes_of_its_part(store: Store) -> None:
    rate = store.select(lambda workspace: workspace.frame_rate)
    rates = collect(rate.changed)
    put_iso(store, 200.0)
    store.put(replace(store.workspace, frame_rate=24.0))
    store.put(replace(store.workspace, frame_rate=float("24")))  # equal, but another object
    assert (rates, rate.value) == ([24.0], 24.0)


def test_undoing_a_step_keeps_what_was_set_after_it(store: Store) -> None:
    first = iso(store)
    put_iso(store, 200.0)
    settings = replace(store.workspace.settings, tolerance=7.0)
    store.put(replace(store.workspace, frame_rate=24.0, settings=settings))
    assert store.undo_stack.count() == 1
    store.put(store.workspace.with_force({"jpeg": True}), "jpeg")
    for _ in range(2):
        store.undo_stack.undo()
    assert store.workspace == Workspace(Scene(), settings, 24.0)
    assert iso(store) == first


def test_the_step_of_a_listener_comes_after_the_step_that_caused_it(
    store: Store,
) -> None:
    first = iso(store)
    scene = store.select(lambda workspace: workspace.scene)
    scene.changed.connect(lambda _: put_iso(store, 300.0) if iso(store) == 200.0 else None)
    put_iso(store, 200.0)
    assert [store.undo_stack.text(at) for at in range(2)] == ["iso 200", "iso 300"]
    scenes = []
    scene.changed.disconnect()
    for _ in range(2):
        store.undo_stack.undo()
        scenes.append(iso(store))
    assert scenes == [200.0, first]


def test_an_edit_in_response_to_an_undo_is_a_new_step(store: Store) -> None:
    first = iso(store)
    put_iso(store, 200.0)
    scene = store.select(lambda workspace: workspace.scene)
    scene.changed.connect(lambda _: put_iso(store, 300.0) if iso(store) == first else None)
    store.undo_stack.undo()
    assert (iso(store), store.undo_stack.count(), store.undo_stack.index()) == (300.0, 1, 1)
    scene.changed.disconnect()
    store.undo_stack.undo()
    assert iso(store) == first


@pytest.mark.parametrize("is_undo", [False, True])
def test_listeners_receive_the_changes_in_order_and_the_present_state_last(
    store: Store, is_undo: bool
) -> None:
    if is_undo:
        put_iso(store, 200.0)
        put_iso(store, 900.0)
    scene, other = (store.select(lambda workspace: workspace.scene) for _ in range(2))
    received: list[float] = []
    received_last: list[float] = []
    scene.changed.connect(lambda _: put_iso(store, 300.0) if iso(store) == 200.0 else None)
    scene.changed.connect(lambda scene: received.append(scene.camera.iso))
    other.changed.connect(lambda scene: received_last.append(scene.camera.iso))
    if is_undo:
        store.undo_stack.undo()
    else:
        put_iso(store, 200.0)
    assert received == [200.0, 300.0]
    assert received_last == [300.0]  # only of the present state, and once


def test_a_step_announces_the_state_before_it_first(store: Store) -> None:
    first, announced = iso(store), []
    store.step_begun.connect(lambda before: announced.append(("before", before.scene.camera.iso)))
    store.select(lambda workspace: workspace.scene).changed.connect(
        lambda scene: announced.append(("now", scene.camera.iso))
    )
    for value in (200.0, 300.0):  # one gesture, one step
        put_iso(store, value, gesture=1)
    store.undo_stack.undo()
    store.put(replace(store.workspace, frame_rate=24.0))
    store.undo_stack.redo()
    assert announced == [
        ("before", first), ("now", 200.0), ("now", 300.0),
        ("before", 300.0), ("now", first), ("before", first), ("now", 300.0),
    ]  # fmt: skip


def test_a_gesture_that_goes_on_after_an_undo_is_a_step_of_its_own(store: Store) -> None:
    for value, gesture in ((200.0, 1), (300.0, 2)):
        put_iso(store, value, gesture)
    store.undo_stack.undo()
    put_iso(store, 400.0, gesture=1)
    assert not store.undo_stack.canRedo()
    store.undo_stack.undo()
    assert iso(store) == 200.0


def test_later_changes_are_announced_although_a_listener_failed(
    store: Store, capfd: pytest.CaptureFixture[str]
) -> None:
    rate = store.select(lambda workspace: workspace.frame_rate)
    received = collect(rate.changed)
    failing = store.select(lambda workspace: 1 / (workspace.frame_rate - 24.0))
    with pytest.raises(ZeroDivisionError):
        store.put(replace(store.workspace, frame_rate=24.0))
    store.put(replace(store.workspace, frame_rate=25.0))
    assert received == [24.0, 25.0]
    assert failing.value == 1.0
