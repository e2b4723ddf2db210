"""Write films: frame by frame, complete or not at all, with a note inside that says what they show.

The note of a GIF file is its comment, that of a PNG file the text ``Description``. MP4 and MKV
files have it in a block at their end that players pass over.
"""

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import cv2

from occ_model.arrays import ByteArray
from occ_model.errors import OutputError, one_line
from occ_model.files.writing import written_whole
from occ_model.video.file.gif import write_gif
from occ_model.video.file.note import mkv_note, mp4_note
from occ_model.video.file.png import write_png

_CODECS = {".mp4": "mp4v", ".mkv": "FFV1"}
"""MPEG-4, which is lossy, and FFV1, which is not."""

LOSSLESS = (".mkv", ".gif", ".png")
"""Endings of files that keep grey frames exactly."""

FILM_ENDINGS = (".mp4", *LOSSLESS)
"""Endings of the files that films are written to."""

_MOST_RATE = {".gif": 50.0}
"""Frames a second; players of GIF files show none faster."""


def write_frames(path: Path, pictures: Iterable[ByteArray], rate: float, note: str) -> int:
    """Write a film, of which one frame is kept in memory.

    Parameters
    ----------
    path
        The file; its ending is one of :data:`FILM_ENDINGS`.
    pictures
        Arrays of uint8, all of one shape: (lines, columns), or (lines, columns, 3) with red, green
        and blue. MP4 and MKV files have an even number of lines and of columns: a last odd one is
        left out.
    rate
        Frames a second.
    note
        What the film shows, kept inside.

    Returns
    -------
    int
        How many frames were written.

    Raises
    ------
    OutputError
        The ending is of no film, the rate too high for its kind, there are no pictures, or the
        file cannot be written.
    """
    check_film_path(path, rate)
    ending = path.suffix.lower()
    with written_whole(path) as temporary:
        count = _WRITERS[ending](temporary, iter(pictures), rate, note)
        if count == 0:
            raise OutputError(f"{one_line(path.name)} is not written: the film has no frames.")
    return count


def check_film_path(path: Path, rate: float) -> None:
    """Refuse a path that no film of a frame rate is written to.

    Raises
    ------
    OutputError
        The ending is of no film, or the rate too high for its kind.
    """
    ending = path.suffix.lower()
    if ending not in FILM_ENDINGS:
        raise OutputError(
            f"{one_line(path.name)} has no ending of a film; use {', '.join(FILM_ENDINGS)}."
        )
    most = _MOST_RATE.get(ending)
    if most is not None and rate > most:
        raise OutputError(
            f"{one_line(path.name)} cannot have {rate:g} frames a second; allowed in a "
            f"{ending[1:].upper()} file: up to {most:g}."
        )


def _by_opencv(path: Path, pictures: Iterator[ByteArray], rate: float, note: str) -> int:
    ending, count = path.suffix.lower(), 0
    writer: cv2.VideoWriter | None = None
    try:
        for picture in pictures:
            lines, columns = (side // 2 * 2 for side in picture.shape[:2])
            if writer is None:
                writer = _opened(path, rate, (lines, columns), picture.ndim == 3)
            cut = picture[:lines, :columns]
            writer.write(cv2.cvtColor(cut, cv2.COLOR_RGB2BGR) if cut.ndim == 3 else cut.copy())
            count += 1
    finally:
        if writer is not None:
            writer.release()
    with path.open("ab") as file:
        file.write(mp4_note(note) if ending == ".mp4" else mkv_note(note))
    return count


def _opened(path: Path, rate: float, size: tuple[int, int], has_colours: bool) -> cv2.VideoWriter:
    ending, (lines, columns) = path.suffix.lower(), size
    code = cv2.VideoWriter.fourcc(*_CODECS[ending])
    writer = cv2.VideoWriter(str(path), cv2.CAP_FFMPEG, code, rate, (columns, lines), has_colours)
    if not writer.isOpened():
        raise OutputError(
            f"This version of OpenCV cannot write {ending[1:].upper()} films of {columns} x "
            f"{lines} pixels; use .gif or .png."
        )
    return writer


_WRITERS: dict[str, Callable[[Path, Iterator[ByteArray], float, str], int]] = {
    ".mp4": _by_opencv,
    ".mkv": _by_opencv,
    ".gif": write_gif,
    ".png": write_png,
}
