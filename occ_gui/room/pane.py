"""Pane of the room: reads pictures on one thread, and measures the map on another."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QFileDialog

from occ_gui.background.task import Task
from occ_gui.core.store import NO_GESTURE, Store
from occ_gui.room.jobs import FloorMap, PictureSource, RoomPicture, make_picture, map_room, plan_of
from occ_gui.room.room_view import RoomView
from occ_gui.scene.scene_store import Gestures
from occ_gui.shell.feature import Pane
from occ_gui.values.choices import FIRST_ROOM, RoomChoice
from occ_gui.widgets.building import ScrollPane
from occ_model.errors import OccError
from occ_model.room.room import Place, Room
from occ_model.room.rooms import load_room, rooms
from occ_model.room.view import aim_at

_LEAST = QSize(360, 180)


class RoomPane(Pane[RoomChoice]):
    """Shows a room from a place that the user drags; a drag is one step to undo."""

    def __init__(self, store: Store) -> None:
        self.view = RoomView(rooms())
        super().__init__(ScrollPane(self.view, _LEAST))
        self._store, self._first_room = store, load_room(FIRST_ROOM)
        self.source: PictureSource | None = None
        self.picture: RoomPicture | None = None
        """The picture from the present place, once it is read."""
        self._reader: Task[PictureSource, RoomPicture] = Task(make_picture, "room")
        self._reader.reported.connect(self._show_picture)
        self._reader.finished.connect(self._show_picture)
        self._reader.failed.connect(self.view.show_failure)
        self._mapper: Task[Room, FloorMap] = Task(map_room, "room map", impatient=True)
        self._mapper.reported.connect(self.view.show_progress)
        self._mapper.finished.connect(self.view.show_map)
        self._mapper.failed.connect(self.view.floor.setText)
        self.tasks = (self._reader, self._mapper)
        self._room_of_map: Room | None = None  # the room whose map is shown or being measured
        self._gestures = Gestures()
        self.view.rooms.textActivated.connect(lambda name: self.choose(name, load_room(name)))
        self.view.file_asked.connect(self._ask_for_file)
        self.view.photo_asked.connect(self._ask_for_photo)
        self.view.photo_closed.connect(
            lambda: self._edit("closing of the photo", photo=None, focal_length=None)
        )
        self.view.focal_length_entered.connect(self._set_focal_length)
        self.view.height_entered.connect(self._lift_camera)
        self.view.map_asked.connect(self._measure_map)
        self.view.plan.camera_moved.connect(self._move_camera)
        self.view.plan.aim_moved.connect(self._aim_camera)

    @property
    def room(self) -> Room:
        """The shown room, with the camera where the user has put it."""
        room = self._store.workspace.room.room
        return self._first_room if room is None else room

    def show_part(self, part: RoomChoice) -> None:
        room, last_source = self.room, self.source
        self.source, self.picture = PictureSource(room, part.photo, part.focal_length), None
        is_new = last_source is None or room.lamps != last_source.room.lamps
        self.view.show_name(part.name)
        self.view.show_plan(room, plan_of(room), is_new=is_new)
        if self._room_of_map is not None and not _have_same_map(room, self._room_of_map):
            self._mapper.cancel()
            self._room_of_map = None
            self.view.show_map(None)
        self._reader.ask(self.source)

    def _edit(self, title: str, gesture: int = NO_GESTURE, **changes: Any) -> None:
        workspace = self._store.workspace
        room = replace(workspace.room, **changes)
        self._store.put(replace(workspace, room=room), title, gesture)

    def choose(self, name: str, room: Room) -> None:
        self._edit(f"room {name}", name=name, room=room)

    def _move_camera(self, x: float, y: float, gesture: int) -> None:
        self._set_camera(replace(self.room.camera, x=x, y=y), "move of the camera", gesture)

    def _lift_camera(self, z: float) -> None:
        camera = replace(self.room.camera, z=z)
        self._set_camera(camera, "height of the camera", self._gestures.of_change())

    def _aim_camera(self, x: float, y: float, gesture: int) -> None:
        camera = aim_at(self.room.camera, x, y, plan_of(self.room).height)
        self._set_camera(camera, "turn of the camera", gesture)

    def _set_camera(self, camera: Place, title: str, gesture: int) -> None:
        room = self.room.replace(camera=camera)
        self._edit(title, gesture, room=room, photo=None, focal_length=None)

    def open_photo(self, path: Path) -> None:
        self._edit(f"photo {path.name}", photo=path, focal_length=None)

    def _set_focal_length(self, focal_length: float) -> None:
        self._edit("focal length of the photo", self._gestures.of_change(),
                   focal_length=focal_length)  # fmt: skip

    def open(self, path: Path) -> None:
        """Show the room of a file, or the reason why it cannot be read."""
        try:
            self.choose(path.name, load_room(path))
        except OccError as error:
            self.view.show_failure(str(error))

    def _measure_map(self) -> None:
        self._room_of_map = self.room
        self._mapper.ask(self.room)

    def _ask_for_file(self) -> None:
        name, _ = QFileDialog.getOpenFileName(
            self.widget, "Open a room file", "", "Room files (*.toml)"
        )
        if name:
            self.open(Path(name))

    def _ask_for_photo(self) -> None:
        name, _ = QFileDialog.getOpenFileName(self.widget, "Open a photo of the room")
        if name:
            self.open_photo(Path(name))

    def _show_picture(self, picture: RoomPicture) -> None:
        is_present = picture.source == self.source
        if is_present and picture.source.photo is not None:
            self.view.show_plan(picture.room, plan_of(picture.room), is_new=False)
        self.view.show_picture(picture, is_present=is_present)
        if is_present and picture.reading is not None:
            self.picture = picture


def _have_same_map(now: Room, then: Room) -> bool:
    """Compare rooms without the camera's x and y, on which a map does not depend."""
    return now.replace(x=then.camera.x, y=then.camera.y) == then
