"""Read a film to its end, or frame by frame as the frames arrive."""

from collections.abc import Callable, Iterable, Iterator

from occ_model.results.decoding import PAPER_DECODER
from occ_model.results.video import Video, VideoFrame
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.scene import Scene
from occ_model.video.reader import VideoReader

_INTERLACED = (
    "The film is interlaced: each of its fields is read as a frame, whose columns are every other "
    "line of the camera, so that its readout time is that of two lines."
)


def decode_video(
    video: Video,
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    readout_tolerance: float | None = None,
    frequency_tolerance: float | None = None,
    progress: Callable[[FilmProgress], object] | None = None,
) -> VideoReading:
    """Read a film: its clock, its packets and the payload.

    Parameters
    ----------
    scene
        What the receiver knows: the scheme, the number of bits, and approximately the switching
        frequency, the exposure time and the readout time. If its light is a lamp, pulses or the
        mains, only the clock is read.
    decoder
        The decoder that finds the chips in each frame.
    readout_tolerance, frequency_tolerance
        Maximum relative errors of the scene's readout time and frequency; None for a value that is
        only a guess. Clocks that imply larger errors are excluded. If both are None, the readout
        time is taken to be right within 5 %. A known frequency (1e-4 for a lamp with a crystal)
        measures the readout time, and shows slow motion.
    progress
        Called after each frame. An exception from it ends the reading.

    Raises
    ------
    ParameterError
        The decoder does not exist, a tolerance is out of range, the scheme cannot be used, or the
        light is none of code, lamp, pulses and mains.
    VideoError
        The file cannot be read.
    """
    tolerances = {
        "readout_tolerance": readout_tolerance,
        "frequency_tolerance": frequency_tolerance,
    }
    reader = reader_of(video, scene, decoder, **tolerances)
    for frame in video:
        film_progress = reader.add(frame)
        if progress is not None:
            progress(film_progress)
    return reader.reading()


def reader_of(
    video: Video, scene: Scene, decoder: str = PAPER_DECODER, **tolerances: float | None
) -> VideoReader:
    """Return a reader of a film's frames; arguments and errors as for :func:`decode_video`."""
    reader = VideoReader(scene_of_frames(video, scene), decoder, times=video.times, **tolerances)
    if video.line_step > 1:
        reader.notes = (_INTERLACED,)
    return reader


def scene_of_frames(video: Video, scene: Scene) -> Scene:
    """Return a scene for the frames of a film: a field takes longer from line to line."""
    if video.line_step == 1:
        return scene
    return scene.replace(readout_time=video.line_step * scene.camera.readout_time)


def decode_frames(
    frames: Iterable[VideoFrame],
    scene: Scene,
    decoder: str = PAPER_DECODER,
    *,
    readout_tolerance: float | None = None,
    frequency_tolerance: float | None = None,
) -> Iterator[FilmProgress]:
    """Read frames as they arrive; yield what is known after each.

    Parameters
    ----------
    frames
        A film, or frames from a camera.
    scene, decoder, readout_tolerance, frequency_tolerance
        As for :func:`decode_video`.

    Raises
    ------
    ParameterError
        As for :func:`decode_video`, raised at once.
    """
    reader = VideoReader(
        scene,
        decoder,
        readout_tolerance=readout_tolerance,
        frequency_tolerance=frequency_tolerance,
    )
    return (reader.add(frame) for frame in frames)
