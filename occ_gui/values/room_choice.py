"""What the user has set about rooms: which one is shown, from where, and which photo of it."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # a window that shows none starts without them
    from occ_model.room.room import Room

FIRST_ROOM = "office"


@dataclass(frozen=True, slots=True)
class RoomChoice:
    name: str = FIRST_ROOM  # of the program's room, or of the file, that it was at first
    # With its camera where the user has put it; None for the first one, as it comes
    room: "Room | None" = None
    # The photo of the room that is shown in place of what its camera sees
    photo: Path | None = None
    # Equivalent focal length of the photo in metres; None for that of its file, or the room's
    focal_length: float | None = None
