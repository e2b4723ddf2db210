"""The results from before the latest gesture stay for a comparison with the present ones."""

from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest
from gui.kinds import Grey, GreyPicture, SnapshotOf
from gui.pane_bench import PaneBench
from gui.stores import store_of
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage
from pytestqt.qtbot import QtBot

from occ_gui.app.panes import picture as picture_pane, profile
from occ_gui.picture.before_controller import BeforeController
from occ_gui.picture.before_wipe import BeforeWipe
from occ_gui.picture.picture_pane import PicturePane
from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.choices import RoomChoice
from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene

Begun = tuple[Snapshot, Snapshot]


@pytest.fixture
def store(small_scene: Scene) -> SceneStore:
    return store_of(small_scene)


@pytest.fixture
def shown() -> list[Snapshot]:
    """Records what is shown as before."""
    return []


@pytest.fixture
def before(store: SceneStore, shown: list[Snapshot]) -> BeforeController:
    return BeforeController(store.store, shown.append)


@pytest.fixture
def begun(store: SceneStore, before: BeforeController, snapshot_of: SnapshotOf) -> Begun:
    """Begin a gesture; return what was shown at first, and what is shown now."""
    first, second = snapshot_of(), snapshot_of(iso=300.0)
    before.show_snapshot(first)
    store.change(1, iso=300.0)
    before.show_snapshot(second)
    return first, second


def test_a_gesture_keeps_what_was_shown_when_it_began_whatever_leaves_the_picture_as_it_is(
    store: SceneStore, before: BeforeController, shown: list[Snapshot], begun: Begun
) -> None:
    first, second = begun
    store.change(1, iso=400.0)
    store.change(1, iso=500.0)
    workspace = store.store.workspace
    store.store.put(replace(workspace, room=RoomChoice("another")), "room")
    store.undo_stack.undo()
    assert shown == [first]
    store.change(2, iso=600.0)
    assert shown == [first, second]


def test_undoing_keeps_what_is_undone(
    store: SceneStore, before: BeforeController, shown: list[Snapshot], begun: Begun
) -> None:
    first, second = begun
    store.undo_stack.undo()
    assert shown == [first, second]
    before.show_snapshot(first)
    store.undo_stack.redo()
    assert shown == [first, second, first]


def test_a_gesture_that_comes_back_to_where_it_began_goes_on(
    store: SceneStore, before: BeforeController, shown: list[Snapshot], snapshot_of: SnapshotOf
) -> None:
    first = snapshot_of()
    before.show_snapshot(first)
    iso = store.scene.camera.iso
    store.change(1, iso=300.0)
    before.show_snapshot(snapshot_of(iso=300.0))
    store.change(1, iso=iso)
    assert store.undo_stack.count() == 0
    assert shown == [first]


def test_a_late_picture_from_the_start_of_the_gesture_is_shown_as_before(
    store: SceneStore, before: BeforeController, shown: list[Snapshot], snapshot_of: SnapshotOf
) -> None:
    first, late, now = snapshot_of(), snapshot_of(iso=300.0), snapshot_of(iso=500.0)
    before.show_snapshot(first)
    store.change(1, iso=300.0)
    store.change(2, iso=500.0)
    assert shown == [first, first]
    before.show_snapshot(late)
    before.show_snapshot(now)
    assert shown == [first, first, late]


def test_nothing_is_shown_as_before_until_there_is_a_picture(
    store: SceneStore, before: BeforeController, shown: list[Snapshot]
) -> None:
    store.change(1, iso=300.0)
    assert shown == []
    assert before.before is None


@pytest.fixture
def pane_with_wipe(qtbot: QtBot) -> tuple[PicturePane, BeforeWipe]:
    pane = PicturePane("picture")
    wipe = BeforeWipe(pane.box)
    pane.caption_row.addWidget(wipe.controls)
    qtbot.addWidget(pane)
    pane.resize(500, 400)
    pane.show()
    return pane, wipe


def paint_flat(snapshot: Snapshot, level: int) -> Snapshot:
    """Return a copy of a snapshot with pictures of a single grey level."""
    painted = deepcopy(snapshot)
    for picture_kind in PICTURES:
        painted.frame.picture(picture_kind)[...] = level
    return painted


def picture(pane: PicturePane) -> Grey:
    image = pane.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), dtype=np.uint8).reshape(image.height(), -1)
    return rows[rows.shape[0] // 2, : image.width()].copy()


def test_the_old_picture_is_left_of_the_line_in_the_picture_the_new_one_right(
    qtbot: QtBot, pane_with_wipe: tuple[PicturePane, BeforeWipe], snapshot_of: SnapshotOf
) -> None:
    pane, wipe = pane_with_wipe
    now, then = paint_flat(snapshot_of(columns=400), 200), paint_flat(snapshot_of(columns=400), 50)
    pane.show_picture(now.frame.image)
    wipe.show_before(then)
    assert 50 not in picture(pane)
    qtbot.keyClick(wipe.checkbox, Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: 50 in picture(pane))
    line = picture(pane)
    left, right = np.flatnonzero(line == 50), np.flatnonzero(line == 200)
    assert left.max() < right.min()
    assert abs(len(left) - len(right)) <= 4
    wipe.slider.setValue(25)
    line = picture(pane)
    assert np.mean(line == 50) == pytest.approx(np.mean(line == 200) / 3, abs=0.02)
    wipe.line.setValue(299.5)
    assert wipe.slider.value() == 75
    qtbot.keyClick(wipe.checkbox, Qt.Key.Key_Space)
    assert 50 not in picture(pane)
    assert not wipe.slider.isVisible()
    qtbot.keyClick(wipe.checkbox, Qt.Key.Key_Space)
    for asked, shown in ((1e4, 399.5), (-1e4, -0.5)):
        wipe.line.setValue(asked)
        assert wipe.line.value() == shown


def test_a_wipe_before_any_change_or_that_is_off_draws_nothing(
    pane_with_wipe: tuple[PicturePane, BeforeWipe], snapshot_of: SnapshotOf
) -> None:
    _, wipe = pane_with_wipe
    wipe.checkbox.setChecked(True)
    wipe.slider.setValue(10)
    assert not wipe.picture.isVisible()
    wipe.checkbox.setChecked(False)
    wipe.show_before(snapshot_of())
    assert not wipe.picture.isVisible()
    assert wipe.picture.boundingRect().isEmpty()
    wipe.checkbox.setChecked(True)
    assert wipe.picture.isVisible()


def test_a_drag_leaves_its_start_as_a_line_and_as_a_picture(
    qtbot: QtBot, small_scene: Scene, grey_picture: GreyPicture
) -> None:
    bench = PaneBench(qtbot, small_scene)
    image = bench.add(picture_pane(bench.store, str)).view
    curves = bench.add(profile(bench.store, bench.results_store, str)).view
    before = BeforeController(bench.store, bench.results_store.show_before)
    bench.called_first.append(before.show_snapshot)
    bench.simulate()
    image.before.checkbox.setChecked(True)
    _, start = curves.simulation.getOriginalDataset()
    for exposure in (80e-6, 90e-6, 100e-6):
        bench.scenes.change(7, exposure_time=exposure)
        bench.simulate()
    _, then = curves.before.getOriginalDataset()
    assert np.array_equal(then, start)
    assert image.before.picture.isVisible()
    grey_picture(image)
    assert before.before is not None
