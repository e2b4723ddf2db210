"""Read a film: frame by frame as it comes, and as a whole at its end."""

from collections.abc import Callable, Iterable, Iterator

from occ_model.receiver.decoders import PAPER_DECODER
from occ_model.results.video import Video, VideoFrame
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.scene import Scene
from occ_model.video.clock import READOUT_TOLERANCE
from occ_model.video.reader import VideoReader


def decode_video(
    video: Video,
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    readout_tolerance: float = READOUT_TOLERANCE,
    progress: Callable[[FilmProgress], object] | None = None,
) -> VideoReading:
    """Read a film: its clock, its packets and the payload.

    Parameters
    ----------
    scene
        What the receiver knows: scheme and number of bits, and roughly the switching frequency, the
        exposure time and the readout time.
    decoder
        The decoder that finds the chips in each frame.
    readout_tolerance
        The fraction by which the scene's readout time may be wrong: frequencies that need another
        one are excluded.
    progress
        Called after each frame. What it raises ends the reading.

    Raises
    ------
    ParameterError
        There is no such decoder, the tolerance is out of range, or the scheme cannot be used.
    VideoError
        The file cannot be read.
    """
    reader = VideoReader(scene, decoder, readout_tolerance=readout_tolerance)
    reader.time_step = video.time_step or 0.0
    for frame in video:
        known = reader.add(frame)
        if progress is not None:
            progress(known)
    return reader.reading()


def decode_frames(
    frames: Iterable[VideoFrame],
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    readout_tolerance: float = READOUT_TOLERANCE,
) -> Iterator[FilmProgress]:
    """Read frames as they come; give what is known after each.

    Parameters
    ----------
    frames
        A film, or frames from a camera.
    scene, decoder, readout_tolerance
        As for :func:`decode_video`.

    Raises
    ------
    ParameterError
        As :func:`decode_video`, at once.
    """
    reader = VideoReader(scene, decoder, readout_tolerance=readout_tolerance)
    return (reader.add(frame) for frame in frames)
