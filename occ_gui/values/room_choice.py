"""What the user has set about rooms: which one is shown, from where, and which photo of it."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # a window that shows none starts without them
    from occ_model.room.room import Room

FIRST_ROOM = "office"


@dataclass(frozen=True, slots=True)
class RoomChoice:
    """What the user has set about rooms.

    Parameters
    ----------
    name
        Of the program's room, or of the file, that it was at first.
    room
        With its camera where the user has put it; None for the first one, as it comes.
    photo
        The photo of the room that is shown in place of what its camera sees.
    focal_length
        Equivalent focal length of the photo in metres; None for that of its file, or the room's.
    """

    name: str = FIRST_ROOM
    room: "Room | None" = None
    photo: Path | None = None
    focal_length: float | None = None
