"""A film: its frames, given one by one however long it is."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from occ_model.arrays import ByteArray
from occ_model.scene.recording import Recording
from occ_model.scene.scene import Scene

USUAL_RATE = 30.0  # frames a second of a film that does not say how many
LATEST_TIME = 1e8  # latest time of a frame from the film's first one, in seconds: three years


@dataclass(frozen=True, eq=False, slots=True)
class VideoFrame:
    """One frame of a film.

    Parameters
    ----------
    index
        Its number, counted from 0 for the film's first frame.
    time
        When the exposure of its first column started, in seconds by the camera's own clock, 0 for
        the film's first frame. In a file: the time that the container states for the frame.
    image : ndarray of uint8, shape (rows, columns)
        The camera's picture in grey levels, columns being the scan axis. It is not enhanced. A
        reader of films also takes the other types of pixels that :func:`occ_model.decode` takes;
        which value is white is that of the first frame.
    exposure_time
        Exposure time by the camera's own clock in seconds; None where the film does not say it.
    scene
        Of a simulated frame the very scene that it shows: ``occ.render(frame.scene, ...)`` gives
        this picture. Its times are those of the real world: with drift of a clock its switching
        frequency, exposure time and readout time differ from those of the film's scene, and its
        start time is reduced by whole packets. None for a frame from a file.
    start
        Of a simulated frame the exact time in the real world when its first column's exposure
        started, in seconds, as the scene's start time counts it. None for a frame from a file.
    """

    index: int
    time: float
    image: ByteArray
    exposure_time: float | None = None
    scene: Scene | None = None
    start: Fraction | None = None


class Video(ABC):
    """A film, simulated or from a file.

    It can be iterated over any number of times; frames are made or read as they are needed, and no
    more than two are kept.

    Attributes
    ----------
    title
        Its name, for a heading.
    shape
        The rows and columns of every frame, columns being the scan axis.
    frame_rate
        Nominal frames a second by the camera's clock; None where a file does not say it.
    frame_count
        How many frames there are, as the recording or the file states; None where it is unknown or
        endless. A damaged file may hold fewer, and of an MKV or WebM file the number is estimated
        from its length until all of it has been read.
    time_step
        The times of the frames are whole multiples of this, in seconds, as far as their container's
        kind states; None where they are not known to be rounded.
    path
        The file, None where the film is simulated.
    scene, recording
        Scene and recording that a film was simulated with, also where its file says so; None for
        others. They are the truth that a reading is judged by: a reader does not look at them.
    """

    title: str
    shape: tuple[int, int]
    frame_rate: float | None
    frame_count: int | None
    time_step: float | None = None
    path: Path | None = None
    scene: Scene | None = None
    recording: Recording | None = None

    @property
    def simulated(self) -> bool:
        """Whether its frames are simulated as they are asked for."""
        return self.path is None

    @property
    def problem(self) -> str | None:
        """A sentence if the film is damaged or ended early, as far as it has been read; or None."""
        return None

    @abstractmethod
    def frames(self, first: int = 0) -> Iterator[VideoFrame]:
        """Yield the frames in order, from the one with the number ``first``.

        Raises
        ------
        ParameterError
            ``first`` is not a whole number from 0.
        VideoError
            The file cannot be read any more.
        """

    @abstractmethod
    def frame(self, index: int) -> VideoFrame:
        """Return one frame; that after the one given before takes the least time.

        Raises
        ------
        ParameterError
            The film holds no frame of that number.
        VideoError
            The file cannot be read any more.
        """

    def __iter__(self) -> Iterator[VideoFrame]:
        return self.frames()
