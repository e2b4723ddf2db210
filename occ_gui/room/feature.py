"""The pane of the room, declared."""

from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.shell.feature import Draw, Feature, Figure, NothingToDraw, Pane
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.room_choice import RoomChoice

if TYPE_CHECKING:
    from occ_gui.room.pane import RoomPane
    from occ_model.figures.drawing import Drawing


def room(store: Store) -> Feature[RoomChoice]:
    def make() -> Pane[RoomChoice]:
        from occ_gui.room.pane import RoomPane

        return RoomPane(store)

    return Feature(
        name="room",
        title="Room",
        help="room.md",
        make=make,
        part=lambda workspace, _: workspace.room,
        goes_on_hidden=True,  # its figure can be exported, and undo does not ask what is seen
        figures=(room_figure(),),
    )


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
