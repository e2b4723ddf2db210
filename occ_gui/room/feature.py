"""The pane of the room, declared."""

from occ_gui.room.figures import room_figure
from occ_gui.shell.feature import Feature, Pane


def room() -> Feature[None]:
    """Declare the pane: it shows a room of its own, not the scene."""
    return Feature(
        name="room",
        title="Room",
        help="room.md",
        make=_make,
        figures=(room_figure(),),
    )


def _make() -> Pane[None]:
    from occ_gui.room.pane import RoomPane

    return RoomPane()
