"""Tell a film from a single picture by the first bytes of a file."""

from pathlib import Path

from occ_model.errors import SceneFileError, VideoError
from occ_model.files.film_kinds import FIRST_BYTES, container_of
from occ_model.files.reading import read_start

_PICTURES = (b"heic", b"heix", b"heim", b"heis", b"mif1", b"avif", b"crx ")  # HEIC, AVIF, CR3
_PNG = b"\x89PNG\r\n\x1a\n"

_ANIMATED = b"acTL"  # the chunk that an animated PNG has before its first picture

_START = 4096


def is_film(path: Path) -> bool:
    """Whether a file holds a film, as far as its first bytes tell; not whether it can be read."""
    try:
        start = read_start(path, _START)
        container_of(path, start[:FIRST_BYTES])
    except (SceneFileError, VideoError):
        return False
    if start[4:8] == b"ftyp" and start[8:12] in _PICTURES:
        return False
    return not start.startswith(_PNG) or _ANIMATED in start.partition(b"IDAT")[0]
