"""The pane of the room shows the place found from a picture, and follows a dragged camera."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from gui.kinds import Grey
from gui.pane_bench import PaneBench
from photo_files import save_as_taken
from pyqtgraph import PlotWidget, TargetItem
from PySide6.QtCore import QPoint, QPointF, Qt
from pytestqt.qtbot import QtBot
from small_rooms import small_room

import occ_model as occ
from occ_gui.app.panes import room
from occ_gui.room import jobs
from occ_gui.room.jobs import FloorMap, RoomPicture, map_room, plan_of
from occ_gui.room.pane import RoomPane
from occ_gui.values.choices import FIRST_ROOM, RoomChoice
from occ_model.figures.room import room_drawing
from occ_model.room.room import Place
from occ_model.room.rooms import load_room
from occ_model.room.view import aim_at, aim_of, rotation
from occ_model.scene.scene import Scene
from occ_model.study.room_map import RoomMapRequest, RoomPoint

ROOM = small_room(turned=0.0, camera=Place(x=0.6, y=0.6, z=-0.2, roll=0.4))


@pytest.fixture(scope="module")
def results() -> dict[tuple[object, ...], Any]:
    """Keep the pictures and readings of the tests in this file."""
    return {}


@pytest.fixture(autouse=True)
def cached_jobs(results: dict[tuple[object, ...], Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Render and read each room only once."""

    def cache_results(work: Callable[..., Any]) -> Callable[..., Any]:
        def look_up(*args: Any, **options: Any) -> Any:
            key = (work, *(each.tobytes() if hasattr(each, "tobytes") else each for each in args))
            if key not in results:
                results[key] = work(*args, **options)
            return results[key]

        return look_up

    for name in ("render_room", "read_room", "room_map"):
        monkeypatch.setattr(jobs, name, cache_results(getattr(jobs, name)))


@pytest.fixture
def same_picture(cached_jobs: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Give every room the picture and reading of one, as few tests depend on its own."""
    room_jobs: Any = jobs
    frame = room_jobs.render_room(ROOM)
    reading = room_jobs.read_room(frame.camera_image, ROOM)
    monkeypatch.setattr(jobs, "render_room", lambda *_, **__: frame)
    monkeypatch.setattr(jobs, "read_room", lambda *_: reading)
    read = SimpleNamespace(reading=reading, room=ROOM, image=frame.camera_image, assumed=())
    monkeypatch.setattr(jobs, "read_room_photo", lambda *_: read)


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> PaneBench:
    bench = PaneBench(qtbot, small_scene)
    workspace = replace(bench.store.workspace, room=RoomChoice("mine", ROOM))
    bench.store.put(workspace)
    bench.store.undo_stack.clear()
    bench.window.resize(900, 600)
    return bench


@pytest.fixture
def pane(bench: PaneBench, qtbot: QtBot) -> RoomPane:
    pane: RoomPane = bench.add(room(bench.store))
    wait_until_read(qtbot, pane)
    return pane


def wait_until_read(qtbot: QtBot, pane: RoomPane) -> RoomPicture:
    qtbot.waitUntil(lambda: pane.is_idle and pane.picture is not None)
    assert pane.picture is not None
    return pane.picture


def drag(
    qtbot: QtBot, view: PlotWidget, item: TargetItem, *path: tuple[float, float], below: float = 0.0
) -> None:
    """Drag an item of a plan along a path, in metres, grabbed so far below its middle."""
    port, box = view.viewport(), view.getViewBox()

    def place(x: float, y: float) -> QPoint:
        return view.mapFromScene(box.mapViewToScene(QPointF(x, y)))

    qtbot.mousePress(
        port, Qt.MouseButton.LeftButton, pos=place(item.pos().x(), item.pos().y() - below)
    )
    for at in path:
        qtbot.mouseMove(port, place(*at))
        qtbot.wait(20)  # the plot ignores moves that follow sooner
    qtbot.mouseRelease(port, Qt.MouseButton.LeftButton, pos=place(*path[-1]))


def test_a_drag_is_one_step_and_undo_restores_the_former_place(
    same_picture: None, bench: PaneBench, pane: RoomPane, qtbot: QtBot
) -> None:
    plan, stack = pane.view.plan, bench.store.undo_stack
    aside = ROOM.replace(camera=aim_at(ROOM.camera, 0.2, 0.2, plan_of(ROOM).height))
    bench.store.put(replace(bench.store.workspace, room=RoomChoice("mine", aside)))
    stack.clear()
    for _ in range(2):
        x, y = plan.camera.pos().x(), plan.camera.pos().y()
        drag(qtbot, plan.plot, plan.camera, (x - 0.1, y), (x - 0.2, y + 0.1), (x - 0.2, y + 0.2))
        assert (pane.room.camera.x, pane.room.camera.y) == pytest.approx((x - 0.2, y + 0.2), 0.1)
    drag(qtbot, plan.plot, plan.aim, (0.7, 0.7), (0.9, 0.9))
    titles = [stack.text(place) for place in range(stack.count())]
    assert titles == ["move of the camera", "move of the camera", "turn of the camera"]
    turned = pane.room.camera
    for _ in range(3):
        stack.undo()
    assert bench.store.workspace.room == RoomChoice("mine", aside)
    assert (plan.camera.pos().x(), plan.camera.pos().y()) == (0.6, 0.6)
    assert wait_until_read(qtbot, pane).room == aside
    for _ in range(3):
        stack.redo()
    assert pane.room.camera == turned


def test_the_height_of_the_camera_is_entered_and_undone(
    same_picture: None, bench: PaneBench, pane: RoomPane, qtbot: QtBot
) -> None:
    field, stack, camera = pane.view.height_field, bench.store.undo_stack, pane.room.camera
    assert field.value() == camera.z
    field.selectAll()
    qtbot.keyClicks(field, "12 cm")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert pane.room.camera == replace(camera, z=0.12)
    assert stack.undoText() == "height of the camera"
    stack.undo()
    assert field.value() == camera.z
    qtbot.keyClicks(field, "high")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert field.notice.text().startswith("Height cannot be")
    assert pane.room.camera == camera


def test_a_camera_that_looks_up_is_moved_by_its_ring_and_turned_by_its_triangle(
    same_picture: None, pane: RoomPane, qtbot: QtBot
) -> None:
    plan, before = pane.view.plan, pane.room.camera
    assert (plan.aim.pos().x(), plan.aim.pos().y()) == pytest.approx((before.x, before.y))
    corner = (
        12.0 * plan.plot.getViewBox().viewPixelSize()[1]
    )  # metres to the triangle's corner, outside the ring
    drag(qtbot, plan.plot, plan.camera, (0.4, 0.4), (0.3, 0.3))
    moved = pane.room.camera
    assert (moved.x, moved.y) == pytest.approx((0.3, 0.3), abs=0.05)
    assert (moved.yaw, moved.pitch) == (before.yaw, before.pitch)
    drag(qtbot, plan.plot, plan.aim, (0.5, 0.5), (0.6, 0.6), below=corner)
    turned = pane.room.camera
    assert (turned.x, turned.y) == (moved.x, moved.y)
    assert (turned.yaw, turned.pitch) != (moved.yaw, moved.pitch)


def test_undo_while_the_pane_is_hidden_removes_the_figure(
    same_picture: None, bench: PaneBench, pane: RoomPane, qtbot: QtBot
) -> None:
    pane.view.plan.camera.setPos(0.3, 0.5)
    qtbot.waitUntil(lambda: pane.picture is not None)
    bench.see("room", seen=False)
    bench.store.undo_stack.undo()
    assert pane.picture is None
    assert wait_until_read(qtbot, pane).room == ROOM


def test_opened_rooms_and_photos_are_steps_to_undo(
    same_picture: None, bench: PaneBench, pane: RoomPane, qtbot: QtBot, tmp_path: Path
) -> None:
    path = tmp_path / "other.toml"
    path.write_text(ROOM.with_sent(code=900).to_toml(), encoding="utf-8")
    pane.open(path)
    pane.open_photo(save_as_taken(tmp_path / "room.jpg", _image(), focal_length=26))
    wait_until_read(qtbot, pane)
    for value in (26.25, 26.5):  # as by the arrows of the field
        pane.view.focal_length.setValue(value)
    stack = bench.store.undo_stack
    titles = [stack.text(place) for place in range(stack.count())]
    assert titles == ["room other.toml", "photo room.jpg", "focal length of the photo"]
    stack.undo()
    assert bench.store.workspace.room.focal_length is None
    stack.undo()
    assert bench.store.workspace.room.photo is None
    qtbot.waitUntil(lambda: pane.is_idle and not pane.view.close_photo.isVisible())
    stack.undo()
    assert pane.view.rooms.placeholderText() == "mine"


def test_the_place_is_shown_with_its_errors_and_the_lamps_with_their_names(
    pane: RoomPane, qtbot: QtBot
) -> None:
    assert re.match(r"I am here: x 0\.\d+ ± 0\.0\d+ m, y ", pane.view.answer.line.text())
    assert "4 of 4 lamps named" in pane.view.answer.details.text()
    shown = wait_until_read(qtbot, pane)
    located = shown.reading.located
    rows = {row[0]: row for row in room_drawing(shown.room, shown.image, shown.reading).rows()}
    assert rows["x"][1:3] == (0.6, pytest.approx(0.6, abs=0.02))
    assert "L3" in rows
    # The ellipse is the covariance's, enlarged by the stated factor, around the place found.
    x, _ = pane.view.plan.ellipse.getData()
    enlarged = float(pane.view.legend.text().split("enlarged ")[1].split(" times")[0])
    assert np.ptp(x) == pytest.approx(4.0 * enlarged * located.errors[0], rel=0.02)
    middle = pane.room.camera.x + enlarged * (located.place.x - pane.room.camera.x)
    assert (x.min() + x.max()) / 2.0 == pytest.approx(middle, abs=1e-9)
    cross, off = pane.view.plan.cross.getData(), located.place.y - pane.room.camera.y
    assert np.ravel(cross) == pytest.approx([middle, pane.room.camera.y + enlarged * off])
    # The number of the first row is not cut off, even for a high picture.
    high = np.zeros((2000, 400), np.uint8)
    pane.view.picture.show_room(replace(shown, image=high, reduced=high, reading=None))
    assert pane.view.picture.plot.viewRange()[1][0] < -20.0


def test_a_dragged_camera_is_read_anew_and_the_old_place_removed(
    pane: RoomPane, qtbot: QtBot
) -> None:
    pane.view.plan.camera.setPos(0.3, 0.5)
    assert pane.view.answer.line.text() == "Reading the picture…"
    assert (pane.room.camera.x, pane.room.camera.y) == (0.3, 0.5)
    ellipse, _ = pane.view.plan.ellipse.getData()
    assert ellipse is None or not len(ellipse)
    assert wait_until_read(qtbot, pane).room.camera.x == 0.3
    pane.view.plan.aim.setPos(0.9, 0.9)
    assert aim_of(pane.room.camera, plan_of(pane.room).height) == pytest.approx((0.9, 0.9))
    assert pane.room.camera.roll == 0.4


@pytest.mark.parametrize("seed", range(2))
def test_a_camera_is_aimed_at_a_point_by_turning_it(seed: int) -> None:
    random = np.random.default_rng([25, seed])
    place = Place(z=0.5, roll=float(random.uniform(-3, 3)))
    x, y = random.uniform(-2.0, 2.0, 2).tolist()
    turned = aim_at(place, x, y, 2.5)
    axis = rotation(turned)[:, 2]
    assert (axis[0] / axis[2] * 2.0, axis[1] / axis[2] * 2.0) == pytest.approx((x, y))
    assert aim_of(turned, 2.5) == pytest.approx((x, y))
    assert math.isclose(turned.roll, place.roll)


def test_an_opened_file_is_named_and_an_unreadable_room_or_photo_is_reported(
    same_picture: None, pane: RoomPane, tmp_path: Path, qtbot: QtBot
) -> None:
    rooms = pane.view.rooms
    rooms.textActivated.emit("corridor")
    assert (rooms.currentText(), pane.room) == ("corridor", load_room("corridor"))
    pane.open(tmp_path / "none.toml")
    assert "none.toml" in pane.view.answer.line.text()
    pane.open_photo(tmp_path / "none.jpg")
    qtbot.waitUntil(lambda: "none.jpg" in pane.view.answer.line.text())
    assert (rooms.currentText(), pane.room) == ("corridor", load_room("corridor"))
    path = tmp_path / "mine.toml"
    path.write_text(ROOM.to_toml(), encoding="utf-8")
    pane.open(path)
    assert pane.room == ROOM
    assert (rooms.currentText(), rooms.placeholderText()) == ("", "mine.toml")


def test_the_first_room_is_one_of_the_program(bench: PaneBench) -> None:
    bench.store.put(replace(bench.store.workspace, room=RoomChoice()))
    pane: RoomPane = bench.add(room(bench.store), seen=False)
    pane.stop()
    assert pane.view.rooms.currentText() == FIRST_ROOM
    assert pane.room == load_room(FIRST_ROOM)


def test_the_map_is_the_studys_and_is_removed_when_the_camera_turns(
    same_picture: None, pane: RoomPane, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(jobs, "PLACES_PER_SIDE", 1)
    view, aim = pane.view, pane.view.plan.aim
    texts: list[str] = []
    pane.tasks[1].reported.connect(lambda _: texts.append(view.floor.text()))
    for is_measured in (False, True):  # the camera also turns while the map is measured
        view.measure.click()
        if is_measured:
            qtbot.waitUntil(lambda: "Map of the floor" in view.floor.text())
            floor_map = map_room(pane.room, lambda _: None)
            assert floor_map.points
            sure = sum(bool(point.sure_places) for point in floor_map.points)
            assert f"{sure} of {len(floor_map.points)} places determined" in view.floor.text()
            assert texts[-1] == "Measuring the floor: 100 %"
            view.plan.camera.setPos(0.5, 0.5)
            assert len(view.plan.floor.points()) == len(floor_map.points)
        aim.setPos(aim.pos().x() + 0.1, aim.pos().y())
        assert view.floor.text() == ""
        assert len(view.plan.floor.points()) == 0
        wait_until_read(qtbot, pane)
        assert view.floor.text() == ""


@pytest.mark.parametrize(("metres", "text"), [(1.0, "1 m"), (0.012, "12 mm")])
def test_the_error_of_a_map_is_written_without_an_exponent(
    same_picture: None, pane: RoomPane, metres: float, text: str
) -> None:
    point = RoomPoint(
        index=0, whole=4, named=4, misread=0, named_wrongly=0, sure_places=1, error=metres,
        stated_error=metres, note="",
    )  # fmt: skip
    pane.view.show_map(FloorMap(RoomMapRequest(ROOM, (0.0,), (0.0,)), (point,)))
    assert pane.view.floor.text().endswith(f"Median error: {text}.")


@cache
def _image() -> Grey:
    return occ.render_room(ROOM.replace(x=0.4, y=0.8)).camera_image


def test_a_photo_is_located_and_its_focal_length_can_be_entered(
    pane: RoomPane, qtbot: QtBot, tmp_path: Path
) -> None:
    view = pane.view
    assert not view.focal_length.isVisible()
    pane.open_photo(save_as_taken(tmp_path / "room.jpg", _image(), focal_length=26))
    wait_until_read(qtbot, pane)
    assert view.answer.line.text().startswith("I am here: x 0.")
    assert "as the EXIF data say" in view.answer.details.text()
    assert "true place" not in view.answer.details.text()
    assert view.plan.camera.pos().x() == pytest.approx(0.4, abs=0.03)
    assert view.focal_length.isVisible()
    assert view.focal_length.value() == 26.0
    view.focal_length.setValue(26.5)
    shown = wait_until_read(qtbot, pane)
    assert "26.5 mm equivalent, as given" in view.answer.details.text()
    assert shown.reading is not None
    drawing = room_drawing(shown.room, shown.image, shown.reading, is_photo=True)
    rows = {row[0]: row for row in drawing.rows()}
    assert rows["x"][1] is None
    view.close_photo.click()
    wait_until_read(qtbot, pane)
    assert "from the true place" in view.answer.details.text()
    assert not view.focal_length.isVisible()


def test_another_room_is_sought_in_the_photo_and_dragging_closes_the_photo(
    pane: RoomPane, qtbot: QtBot, tmp_path: Path
) -> None:
    pane.open_photo(save_as_taken(tmp_path / "room.jpg", _image()))
    wait_until_read(qtbot, pane)
    assert "the photo has no EXIF data on it" in pane.view.answer.details.text()
    pane.choose("other", ROOM.with_sent(code=900))
    wait_until_read(qtbot, pane)
    assert pane.view.answer.line.text() == "The place is not determined"
    pane.view.plan.camera.setPos(0.3, 0.5)
    assert pane.source.photo is None
