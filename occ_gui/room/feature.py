"""The pane of the room, declared."""

from occ_gui.core.store import Store
from occ_gui.room.figures import room_figure
from occ_gui.shell.feature import Feature, Pane
from occ_gui.values.room_choice import RoomChoice


def room(store: Store) -> Feature[RoomChoice]:
    """Declare the pane: it shows a room of its own, not the scene."""

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
