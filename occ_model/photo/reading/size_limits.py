"""Limit a photo by its size, whatever its format."""

from pathlib import Path

from occ_model.errors import PhotoError, one_line

_MOST_MEMORY = 950_000_000
"""Bytes of memory for reading a photo; numpy, OpenCV and the decoders' libraries take 150 MB more.

A picture of 170 million pixels takes 4 bytes for each of them while it is decoded, whatever its
colours, and 1 for the channel.
"""

_LONGEST_SIDE = 1_000_000
"""Pixels of a photo's longer side: as many as a scene has columns, and ten times its rows.

The means of columns and of lines are of 64 bits, and are sorted: of a photo of one line they
would take many times the memory and time of its pixels.
"""


def check_pixels(path: Path, width: int, height: int, max_pixels: int) -> None:
    """Refuse a picture of more pixels than were asked for, before any of it is decoded."""
    if width * height > max_pixels:
        raise PhotoError(
            f"{one_line(str(path))} has {width:,} x {height:,} pixels, "
            f"{count_of_pixels(width * height)}; allowed: at most {allowed_pixels(max_pixels)}"
        )


def allowed_pixels(max_pixels: int) -> str:
    """Write the largest number of pixels, and how to allow more."""
    return f"{count_of_pixels(max_pixels)}; raise max_pixels to read it."


def count_of_pixels(pixels: int) -> str:
    """Write a number of pixels, in millions where two decimals suffice."""
    if pixels >= 1_000_000 and pixels % 10_000 == 0:
        return f"{pixels / 1e6:,.10g} million"
    return f"{pixels:,}"


def check_sides(path: Path, width: int, height: int) -> None:
    """Refuse a picture with a side longer than any camera's, before any of it is decoded."""
    if max(width, height) > _LONGEST_SIDE:
        raise PhotoError(
            f"{one_line(str(path))} has {width:,} x {height:,} pixels; "
            f"allowed: at most {_LONGEST_SIDE:,} along each side."
        )


def check_bytes(path: Path, width: int, height: int, decoding: float, kept: int) -> None:
    """Refuse a picture that would take too much memory, by the bytes that it takes.

    ``decoding``: bytes that decoding takes, in proportion to the pixels. ``kept``: bytes of the
    file that are kept in memory meanwhile.
    """
    if decoding + kept > _MOST_MEMORY:
        most = width * height * max(_MOST_MEMORY - kept, 0) / decoding
        raise PhotoError(
            f"{one_line(str(path))} has {width:,} x {height:,} pixels, which take "
            f"{(decoding + kept) / 1e9:.2f} GB of memory to be decoded; allowed: at most "
            f"{_MOST_MEMORY / 1e9:.2f} GB, {most / 1e6:.1f} million pixels of this kind."
        )
