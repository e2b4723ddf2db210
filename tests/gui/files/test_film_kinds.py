"""Which files are opened as films: those of a film's kind, and pictures that move."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from occ_gui.files.file_controller import _is_film

PICTURES = [Image.fromarray(np.full((4, 6), 40 * n, dtype=np.uint8)) for n in range(3)]


@pytest.mark.parametrize("name", ["a.gif", "a.png"])
def test_a_picture_that_moves_is_a_film_and_one_that_stands_is_a_photo(
    tmp_path: Path, name: str
) -> None:
    path = tmp_path / name
    PICTURES[0].save(path, save_all=True, append_images=PICTURES[1:], duration=40)
    assert _is_film(path)
    PICTURES[0].save(path)
    assert not _is_film(path)


def test_films_are_known_by_their_endings_and_damaged_pictures_are_photos(tmp_path: Path) -> None:
    assert _is_film(Path("a.MP4"))
    assert _is_film(Path("b.mkv"))
    assert not _is_film(Path("c.jpg"))
    damaged = tmp_path / "damaged.gif"
    damaged.write_bytes(b"GIF89a")
    assert not _is_film(damaged)
    assert not _is_film(tmp_path / "missing.png")
