"""A film is distinguished from a picture by the contents of its file, whatever its name."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from occ_model.files.reading import is_film

PICTURES = [Image.fromarray(np.full((4, 6), 40 * n, dtype=np.uint8)) for n in range(3)]


@pytest.mark.parametrize("kind", ["GIF", "PNG"])
def test_an_animated_picture_is_a_film_and_a_still_one_is_not(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "picture"
    PICTURES[0].save(path, kind, save_all=True, append_images=PICTURES[1:], duration=40)
    assert is_film(path)
    content = path.read_bytes()
    path.write_bytes(content[:10])
    assert not is_film(path)
    PICTURES[0].save(path, kind)
    assert not is_film(path)


@pytest.mark.parametrize(
    ("start", "expected"),
    [
        (b"\x00\x00\x00\x18ftypisom", True),
        (b"\x00\x00\x00\x08wide", True),
        (b"RIFF....AVI LIST", True),
        (b"\x1aE\xdf\xa3", True),
        (b"RIFF....WEBPVP8 ", False),
        (b"\x00\x00\x00\x18ftypheic", False),
        (b"\x00\x00\x00\x18ftyphevc", False),
        (b"\x00\x00\x00\x18ftypmif1", False),
        (b"\x00\x00\x00\x18ftypavif", False),
        (b"\x00\x00\x00\x18ftypcrx ", False),
        (b"\xff\xd8\xff\xe0", False),
        (b"", False),
    ],
)
def test_the_first_bytes_distinguish_films_from_photos(
    tmp_path: Path, start: bytes, expected: bool
) -> None:
    path = tmp_path / "file"
    path.write_bytes(start + bytes(64))
    assert is_film(path) is expected
    assert not is_film(tmp_path / "missing.mkv")
