"""Figure of the room: its plan, the picture and the place that it tells."""

from typing import TYPE_CHECKING

from occ_gui.shell.figures import Draw, Figure, NothingToDraw
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.room.pane import RoomPane
    from occ_model.figures.drawing import Drawing


def room_figure() -> Figure:
    """Declare the figure, which there is once the picture of the present place is read."""
    return Figure(name="room", title="Room", draw=_figure)


def _figure(pane: "RoomPane | None", _shown: Snapshot) -> Draw:
    there = None if pane is None else pane.shown
    if there is None or there.reading is None:
        raise NothingToDraw("The room's picture is not read yet: open its pane and wait a moment.")
    shown, reading = there, there.reading

    def draw() -> "Drawing":
        from occ_model.figures.room import room_drawing

        is_photo = shown.look.photo is not None
        return room_drawing(shown.room, shown.image, reading, is_photo=is_photo)

    return draw
