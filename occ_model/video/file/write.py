"""Write films frame by frame, completely or not at all, with a note on what they show.

The note of a GIF file is its comment, that of a PNG file the text ``Description``. MP4 and MKV
files have it in a block at their end that players ignore.

PyAV 18.1 was measured as an alternative, on 60 frames of 1280 x 720. It takes 103 MB more, writes
no note into GIF and PNG files, and takes 7.7 times as long for an animated PNG. Frame times agree
to 2e-16 s, but those of an animated PNG deviate by up to 0.2 ms. Decoding takes 1.6 times as long
for MP4, and 0.4 times for GIF.
"""

import errno
import os
import shutil
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import cv2

from occ_model.arrays import ByteArray
from occ_model.errors import OutputError, ParameterError, one_line
from occ_model.files.writing import write_atomically
from occ_model.results.video import USUAL_RATE, Video
from occ_model.scene.provenance import Provenance
from occ_model.video.file.animated_pictures import write_gif, write_png
from occ_model.video.file.note import mkv_note, mp4_note
from occ_model.video.file.quiet import silence_opencv

_CODECS = {".mp4": "mp4v", ".mkv": "FFV1"}  # MPEG-4, which is lossy, and FFV1, which is lossless
LOSSLESS = (".mkv", ".gif", ".png")  # endings of files that keep grey frames exactly
FILM_ENDINGS = (".mp4", *LOSSLESS)  # endings of films' files

_RATES = {  # frames per second that a file can state, or that players can show (GIF)
    ".mp4": (0.01, 65_535.0),
    ".mkv": (0.01, 1e5),
    ".gif": (0.002, 50.0),
    ".png": (1e-4, 65_535.0),
}


def write_frames(path: Path, pictures: Iterable[ByteArray], rate: float, note: str) -> int:
    """Write a film frame by frame; return the number of frames.

    ``pictures``: uint8 of a common shape, (lines, columns) or (lines, columns, 3) with red, green
    and blue. MP4 and MKV files need even numbers of both, so a last odd one is omitted. Because
    OpenCV reports no errors, the frames in its file are counted before it replaces an older file.
    """
    check_film_path(path, rate)
    name, ending = one_line(path.name), path.suffix.lower()
    shape: tuple[int, ...] = ()

    def check_pictures() -> Iterator[ByteArray]:
        nonlocal shape
        for picture in pictures:
            if not shape:
                shape = picture.shape
                check_film_path(path, rate, (shape[0], shape[1]))
            elif picture.shape != shape:
                raise OutputError(
                    f"{name} is not written: a frame has another size than the first."
                )
            yield picture

    with write_atomically(path) as temporary:
        count = _WRITERS[ending](temporary, check_pictures(), rate, note)
        if count == 0:
            raise OutputError(f"{name} is not written: the film has no frames.")
        if ending in _CODECS:
            stored = _count_frames(temporary)
            if stored != count:
                raise OutputError(
                    f"{one_line(str(path))} cannot be written: only {stored} of {count} frames can "
                    "be read back; the disk was full, or failed."
                )
    return count


def check_film_path(path: Path, rate: float, size: tuple[int, int] | None = None) -> None:
    """Refuse a path to which no film of this rate and size (lines, columns) can be written."""
    ending = path.suffix.lower()
    if ending not in FILM_ENDINGS:
        raise OutputError(
            f"{one_line(path.name)} does not have the ending of a film; "
            f"use {', '.join(FILM_ENDINGS)}."
        )
    least, most = _RATES[ending]
    allowed = f"allowed in {'an' if ending.startswith('.m') else 'a'} {ending[1:].upper()} file"
    if not least <= rate <= most:
        raise OutputError(
            f"{one_line(path.name)} cannot have {rate:g} frames a second; {allowed}: {least:g} to "
            f"{most:,g}."
        )
    if size is not None and ending in _CODECS and min(size) < 2:
        raise OutputError(
            f"{one_line(path.name)} cannot have {size[1]:,} x {size[0]:,} pixels; {allowed}: from "
            "2 a side; .gif and .png take any."
        )


def _count_frames(path: Path) -> int:
    """Count the frames of a film that was just written, without decoding them."""
    with silence_opencv():
        capture = cv2.VideoCapture(str(path), cv2.CAP_FFMPEG, (cv2.CAP_PROP_FORMAT, -1))
        count = 0
        while capture.grab():
            count += 1
        capture.release()
    return count


def _write_by_opencv(path: Path, pictures: Iterator[ByteArray], rate: float, note: str) -> int:
    ending, count = path.suffix.lower(), 0
    writer: cv2.VideoWriter | None = None
    try:
        for picture in pictures:
            lines, columns = (side // 2 * 2 for side in picture.shape[:2])
            if writer is None:
                writer = _open_writer(path, rate, (lines, columns), picture.ndim == 3)
            even_part = picture[:lines, :columns]
            pixels = (
                cv2.cvtColor(even_part, cv2.COLOR_RGB2BGR)
                if even_part.ndim == 3
                else even_part.copy()
            )
            with silence_opencv():
                writer.write(pixels)
            _check_space(path)
            count += 1
    finally:
        if writer is not None:
            with silence_opencv():
                writer.release()
    with path.open("ab") as file:
        file.write(mp4_note(note) if ending == ".mp4" else mkv_note(note))
        file.flush()
        os.fsync(file.fileno())  # some disks report only here that they are full
    return count


def _check_space(path: Path) -> None:
    """Raise an error if the disk is full, which OpenCV does not report."""
    if shutil.disk_usage(path.parent).free == 0:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def _open_writer(
    path: Path, rate: float, size: tuple[int, int], has_colours: bool
) -> cv2.VideoWriter:
    ending, (lines, columns) = path.suffix.lower(), size
    code = cv2.VideoWriter.fourcc(*_CODECS[ending])
    with silence_opencv():
        writer = cv2.VideoWriter(
            str(path), cv2.CAP_FFMPEG, code, rate, (columns, lines), has_colours
        )
    if not writer.isOpened():
        _check_space(path)
        raise OutputError(
            f"No {ending[1:].upper()} film of {columns:,} x {lines:,} pixels can be started: the "
            "disk is full, or OpenCV cannot write such a film; use .gif or .png."
        )
    return writer


_WRITERS: dict[str, Callable[[Path, Iterator[ByteArray], float, str], int]] = {
    ".mp4": _write_by_opencv,
    ".mkv": _write_by_opencv,
    ".gif": write_gif,
    ".png": write_png,
}


def write_video(
    video: Video, path: str | Path, progress: Callable[[int], object] = lambda _frames: None
) -> int:
    """Write a film to a file.

    Its frames have equal time steps, regardless of jitter. The scene and the recording are stored
    in the file; :func:`occ_model.load_video` restores them.

    Parameters
    ----------
    video
        The film, which must have an end.
    path
        The file. ``.mkv``, ``.gif`` and ``.png`` keep every grey level; ``.mp4`` does not, because
        its codec, MPEG-4, is lossy. The times are rounded to hundredths of a second in GIF and to
        thousandths in MKV files, and the frame rate in MP4 and MKV files by up to 0.001 Hz.
    progress
        Called with the number of frames written after each one; an exception from it ends the work.

    Returns
    -------
    int
        The number of frames written.

    Raises
    ------
    ParameterError
        The film is endless.
    OutputError
        The file's ending is not that of a film, files of this kind do not allow the frame rate or
        size, or the file cannot be written, for example on a full disk; an older file is unchanged.
    """
    path = Path(path)
    rate = video.frame_rate or USUAL_RATE
    check_film_path(path, rate, video.shape)
    if video.simulated and video.frame_count is None:
        raise ParameterError.of(
            "frames", "None, a film without end", "a number", condition="to be written"
        )

    def pictures() -> Iterator[ByteArray]:
        for number, frame in enumerate(video, 1):
            yield frame.image
            progress(number)

    return write_frames(path, pictures(), rate, _note(video))


def _note(video: Video) -> str:
    if video.scene is None:
        return video.title
    recording = () if video.recording is None else tuple(video.recording.lines())
    seed = getattr(getattr(video, "settings", None), "seed", None)
    return Provenance("Simulated film", {"at hand": video.scene}, seed, recording).text()
