"""Write films frame by frame, completely or not at all, with a note on what they show.

The note of a GIF file is its comment, that of a PNG file the text ``Description``. MP4 and MKV
files have it in a block at their end that players ignore.
"""

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from occ_model.arrays import Samples
from occ_model.errors import OutputError, ParameterError, one_line
from occ_model.files.writing import check_ending, write_atomically
from occ_model.results.video import USUAL_RATE, Video
from occ_model.scene.provenance import Provenance
from occ_model.video.file.animated_pictures import write_gif, write_png
from occ_model.video.file.encoded import ENCODINGS, write_encoded

_DEEP = (".mkv", ".png")  # endings of files that keep 16 bits
LOSSLESS = (".mkv", ".gif", ".png")  # endings of files that keep grey frames of 8 bits exactly
FILM_ENDINGS = (".mp4", *LOSSLESS)  # endings of films' files

_RATES = {  # frames per second that a file can state, or that players can show (GIF)
    ".mp4": (0.01, 65_535.0),
    ".mkv": (0.01, 1e5),
    ".gif": (0.002, 50.0),
    ".png": (1e-4, 65_535.0),
}


def write_frames(path: Path, pictures: Iterable[Samples], rate: float, note: str) -> int:
    """Write a film frame by frame; return the number of frames.

    ``pictures``: of a common shape, (lines, columns) or (lines, columns, 3) with red, green and
    blue; of 8 bits, or grey of 16 for MKV and PNG files. MP4 files need even numbers of lines and
    columns, so a last odd one is omitted.
    """
    check_film_path(path, rate)
    name, ending = one_line(path.name), path.suffix.lower()
    shape: tuple[int, ...] = ()

    def check_pictures() -> Iterator[Samples]:
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
    return count


def check_film_path(path: Path, rate: float, size: tuple[int, int] | None = None) -> None:
    """Refuse a path to which no film of this rate and size (lines, columns) can be written."""
    ending = check_ending(path, "a film", FILM_ENDINGS)
    least, most = _RATES[ending]
    allowed = f"allowed in {'an' if ending.startswith('.m') else 'a'} {ending[1:].upper()} file"
    if not least <= rate <= most:
        raise OutputError(
            f"{one_line(path.name)} cannot have {rate:g} frames a second; {allowed}: {least:g} to "
            f"{most:,g}."
        )
    if size is not None and ending in ENCODINGS and ENCODINGS[ending].even and min(size) < 2:
        raise OutputError(
            f"{one_line(path.name)} cannot have {size[1]:,} x {size[0]:,} pixels; {allowed}: from "
            "2 a side; .mkv, .gif and .png take any."
        )


_WRITERS: dict[str, Callable[[Path, Iterator[Samples], float, str], int]] = {
    ".mp4": write_encoded,
    ".mkv": write_encoded,
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
        The file. ``.mkv`` and ``.png`` keep every grey level and colour, ``.gif`` grey levels of 8
        bits, and 256 colours a frame; ``.mp4`` is lossy, because its codec is MPEG-4. The times
        are rounded to hundredths of a second in GIF and to thousandths in MKV files.
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

    def pictures() -> Iterator[Samples]:
        for number, frame in enumerate(video, 1):
            samples = frame.samples if path.suffix.lower() in _DEEP else None
            yield frame.image if samples is None else samples
            progress(number)

    return write_frames(path, pictures(), rate, _note(video))


def _note(video: Video) -> str:
    if video.scene is None:
        return video.title
    recording = () if video.recording is None else tuple(video.recording.lines())
    seed = getattr(getattr(video, "settings", None), "seed", None)
    return Provenance("Simulated film", {"of this file": video.scene}, seed, recording).text()
