"""The pane of the room: pictures are taken and read on one thread, the map measured on another."""

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QFileDialog

from occ_gui.background.task import Reporter, Task
from occ_gui.room.jobs import FloorMap, Look, ShownRoom, map_room, plan_of, show_room
from occ_gui.room.room_view import RoomView
from occ_gui.shell.feature import Pane
from occ_gui.widgets.scroll_pane import ScrollPane
from occ_model.errors import OccError
from occ_model.room.room import Room
from occ_model.room.rooms import load_room, rooms
from occ_model.room.view import aimed_at

_LEAST = QSize(360, 180)
_FIRST = "office"


class RoomPane(Pane[None]):
    """Shows a room from a place that the user drags."""

    def __init__(self) -> None:
        self.view = RoomView(rooms())
        super().__init__(ScrollPane(self.view, _LEAST))
        self.room = load_room(_FIRST)
        self.look = Look(self.room)
        """What is shown, or looked at."""
        self.shown: ShownRoom | None = None
        """The last picture of the present place, once it is read."""
        self._look: Task[Look, ShownRoom] = Task(show_room, "room")
        self._look.reported.connect(self._show)
        self._look.finished.connect(self._show)
        self._look.failed.connect(self.view.show_failure)
        self._map: Task[Room, FloorMap] = Task(_map, "room map", impatient=True)
        self._map.reported.connect(self.view.show_progress)
        self._map.finished.connect(self.view.show_map)
        self._map.failed.connect(self.view.show_no_map)
        self.tasks = (self._look, self._map)
        self._mapped: Room | None = None
        """The room whose map is shown or measured."""
        self.view.room_chosen.connect(lambda name: self.take(load_room(name)))
        self.view.file_asked.connect(self._ask_for_file)
        self.view.photo_asked.connect(self._ask_for_photo)
        self.view.photo_closed.connect(lambda: self.move(self.room))
        self.view.focal_length_given.connect(self._with_focal_length)
        self.view.map_asked.connect(self._measure)
        self.view.plan.camera_moved.connect(lambda x, y: self.move(self.room.replace(x=x, y=y)))
        self.view.plan.aim_moved.connect(self._aim)
        self.view.rooms.setCurrentText(_FIRST)
        self.take(self.room)

    def take(self, room: Room) -> None:
        """Show another room; a photo that is shown is read as one of it."""
        self._show_room(replace(self.look, room=room), is_new=True)

    def move(self, room: Room) -> None:
        """Show the room from another place: no photo."""
        self._show_room(Look(room), is_new=False)

    def open_photo(self, path: Path) -> None:
        """Show a photo of the room, and where it was taken."""
        self._show_room(Look(self.room, path), is_new=False)

    def _with_focal_length(self, focal_length: float) -> None:
        self._show_room(replace(self.look, focal_length=focal_length), is_new=False)

    def open(self, path: Path) -> None:
        """Show the room of a file; a sentence says why it cannot be read."""
        try:
            self.take(load_room(path))
        except OccError as error:
            self.view.show_failure(str(error))
        else:
            self.view.show_file(path.name)

    def _aim(self, x: float, y: float) -> None:
        height = plan_of(self.room).height
        self.move(self.room.replace(camera=aimed_at(self.room.camera, x, y, height)))

    def _show_room(self, look: Look, *, is_new: bool) -> None:
        room = look.room
        self.look, self.room, self.shown = look, room, None
        self.view.show_plan(room, plan_of(room), is_new=is_new)
        if self._mapped is not None and not _have_one_map(room, self._mapped):
            self._map.cancel()
            self._mapped = None
            self.view.show_map(None)
        self._look.ask(look)

    def _measure(self) -> None:
        self._mapped = self.room
        self._map.ask(self.room)

    def _ask_for_file(self) -> None:
        chosen, _ = QFileDialog.getOpenFileName(
            self.widget, "Open a room file", "", "Room files (*.toml)"
        )
        if chosen:
            self.open(Path(chosen))

    def _ask_for_photo(self) -> None:
        chosen, _ = QFileDialog.getOpenFileName(self.widget, "Open a photo of the room")
        if chosen:
            self.open_photo(Path(chosen))

    def _show(self, shown: ShownRoom) -> None:
        is_present = shown.look == self.look
        if is_present and shown.look.photo is not None:
            self.view.show_plan(shown.room, plan_of(shown.room), is_new=False)
        self.view.show_picture(shown, is_present=is_present)
        if is_present and shown.reading is not None:
            self.shown = shown


def _have_one_map(now: Room, then: Room) -> bool:
    """Compare rooms: another place of the camera is no matter of a map, its turn and height are."""
    return now.replace(x=then.camera.x, y=then.camera.y) == then


def _map(room: Room, report: Reporter) -> FloorMap:
    return map_room(room, report)
