"""A file that its decoder would take too long for is refused before it is opened."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from PIL import Image

import occ_model as occ
from occ_model.photo.reading.limits import (
    _MOST_BYTES,
    _MOST_BYTES_IN_PYTHON,
    _MOST_BYTES_OF_TIFF,
    check_decoder,
    check_file_size,
)

PATH = Path("a-photo")


@pytest.mark.parametrize(("kind", "most"), _MOST_BYTES.items())
def test_a_file_may_have_as_many_bytes_as_are_read_within_seconds(kind: str, most: int) -> None:
    check_file_size(PATH, kind, most)
    with pytest.raises(occ.PhotoError, match=f"has {most + 1:,} bytes; .*up to {most:,}"):
        check_file_size(PATH, kind, most + 1)


def test_formats_that_are_read_as_fast_as_they_are_copied_have_no_limit() -> None:
    check_file_size(PATH, "TIFF", 10**12)


def picture_of(decoder: str, kind: str) -> Any:
    return SimpleNamespace(tile=[(decoder, (0, 0, 1, 1), 0, "")], format=kind)


@pytest.mark.parametrize(
    ("decoder", "kind", "most"),
    [("libtiff", "TIFF", _MOST_BYTES_OF_TIFF), ("qoi", "QOI", _MOST_BYTES_IN_PYTHON)],
)
def test_a_slow_decoder_has_a_limit_of_its_own(decoder: str, kind: str, most: int) -> None:
    Image.init()  # Pillow knows its decoders in Python once they are imported
    check_decoder(PATH, picture_of(decoder, kind), most)
    with pytest.raises(
        occ.PhotoError, match=rf"\({'compressed ' if kind == 'TIFF' else ''}{kind}\)"
    ):
        check_decoder(PATH, picture_of(decoder, kind), most + 1)
    check_decoder(PATH, picture_of("raw", kind), 10**12)
