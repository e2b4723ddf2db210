"""What the user has set about rooms: which one is shown, from where, and which photo of it."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # a window that shows none starts without them
    from occ_model.room.room import Room

FIRST_ROOM = "office"


@dataclass(frozen=True, slots=True)
class RoomChoice:
    name: str = FIRST_ROOM  # of the built-in room, or of the file, that the room comes from
    # The room with the camera where the user has put it; None for the first room unchanged
    room: "Room | None" = None
    # The photo of the room that is shown in place of the simulated picture
    photo: Path | None = None
    # Equivalent focal length of the photo in metres; None for that in its file, or the room's
    focal_length: float | None = None
