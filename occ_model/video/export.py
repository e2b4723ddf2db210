"""Write a film to a file, with the scene and the recording inside."""

from collections.abc import Callable, Iterator
from pathlib import Path

from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError
from occ_model.results.video import Video
from occ_model.scene.provenance import Provenance
from occ_model.video.file.write import check_film_path, write_frames

_USUAL_RATE = 30.0  # frames a second of a film that does not say how many


def write_video(
    video: Video, path: str | Path, progress: Callable[[int], object] = lambda _frames: None
) -> int:
    """Write a film to a file.

    Its frames get equal steps of time, whatever the jitter. The scene and the recording are kept
    inside; :func:`occ_model.load_video` gives them back.

    Parameters
    ----------
    video
        The film; it has an end.
    path
        The file. ``.mkv``, ``.gif`` and ``.png`` keep every grey level, ``.mp4`` does not: its
        codec, MPEG-4, is lossy. A GIF's times are rounded to hundredths of a second, those of an
        MKV to thousandths, and the frame rate of MP4 and MKV by up to 0.001 Hz.
    progress
        Called with the number of frames written after each one; what it raises ends the work.

    Returns
    -------
    int
        How many frames were written.

    Raises
    ------
    ParameterError
        The film has no end.
    OutputError
        The file's ending is of no film, that kind of file has no such frame rate or size, or it
        cannot be written, as on a full disk; an older file is unchanged.
    """
    path = Path(path)
    rate = video.frame_rate or _USUAL_RATE
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
