"""Load rooms that come with the program, and room files."""

from pathlib import Path

from occ_model.errors import PresetError, SceneFileError, one_line, quote
from occ_model.files.reading import read_text
from occ_model.files.resources import resource_names, resource_text
from occ_model.room.room import Room

_FOLDER, _ENDING = "rooms", ".toml"


def rooms() -> tuple[str, ...]:
    """List the names of the rooms that come with the program."""
    return resource_names(_FOLDER, _ENDING)


def load_room(name: str | Path) -> Room:
    """Load a room of the program by its name, or a room file by its path.

    Raises
    ------
    PresetError
        No room has that name; the message lists the known names.
    SceneFileError, ParameterError
        The file cannot be read, or is not a room.
    """
    if isinstance(name, str) and name in rooms():
        return Room.from_toml(resource_text(_FOLDER, name + _ENDING))
    path = Path(name) if isinstance(name, str | Path) else None
    if path is None or path.suffix != _ENDING:
        raise PresetError(
            f"There is no room {quote(name)}. Known are {', '.join(rooms())}, and files *{_ENDING}."
        )
    text = read_text(path)
    try:
        return Room.from_toml(text)
    except SceneFileError as error:
        raise SceneFileError(f"{one_line(str(path))} cannot be read. {error}") from None
