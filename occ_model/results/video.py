"""A film, whose frames are read one by one, so that it can have any length."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from occ_model.arrays import ByteArray, Samples
from occ_model.scene.recording import Recording
from occ_model.scene.scene import Scene

USUAL_RATE = 30.0  # assumed frames a second of a film that does not state its rate
LATEST_TIME = 1e8  # latest time of a frame after the film's first one, in seconds: three years


@dataclass(frozen=True, slots=True)
class FilmTimes:
    """What is known of the times of a film's frames.

    Parameters
    ----------
    resolution
        Step in seconds to which the file rounds the times, which are those of the recording; 0 if
        they are exact.
    slowdown
        How many times slower the film plays than it was recorded, as the file states it. The
        frames' times and the frame rate are those of the recording.
    """

    resolution: float = 0.0
    slowdown: float = 1.0


@dataclass(frozen=True, eq=False, slots=True)
class VideoFrame:
    """One frame of a film.

    Parameters
    ----------
    index
        Its number in the film, from 0.
    time
        When the exposure of its first column started, in seconds by the camera's own clock, from
        the film's first frame; for a file, the time that the container states.
    image : ndarray of uint8, shape (rows, columns) or (rows, columns, 3)
        The camera's picture, not enhanced, with columns as the scan axis: in grey levels, or in
        red, green and blue for a colour camera or a film read in colours. A reader of films also
        takes the other types of pixels of :func:`occ_model.decode`; the first frame's type sets the
        value of white.
    exposure_time
        Exposure time in seconds by the camera's own clock; None if the film does not state it.
    scene
        For a simulated frame, the exact scene that it shows: ``occ.render(frame.scene, ...)`` gives
        this picture. Its times are real times: if a clock drifts, its switching frequency, exposure
        time and readout time differ from those of the film's scene. Its start time is reduced by
        whole periods of its light. None for a frame from a file.
    start
        For a simulated frame, the exact real time at which its first column's exposure started, in
        seconds, counted as the scene's start time. None for a frame from a file.
    first_column
        Where the first column lies, in columns from that of the film's frames: 0.5 for the field of
        an interlaced film whose lines lie between those of the other.
    samples : ndarray of uint16, shape (rows, columns)
        The picture in 16 bits, if the file has more than 8; else None.
    """

    index: int
    time: float
    image: ByteArray
    exposure_time: float | None = None
    scene: Scene | None = None
    start: Fraction | None = None
    first_column: float = 0.0
    samples: Samples | None = None


class Video(ABC):
    """A film, simulated or from a file.

    It can be iterated any number of times. Frames are made or read when they are needed, and at
    most two are kept.

    Attributes
    ----------
    title
        Its name, for a heading.
    shape
        Rows and columns of every frame, with columns as the scan axis.
    frame_rate
        Nominal frames a second by the camera's clock; None if a file does not state the rate.
    frame_count
        Number of frames by the recording or the file; None if unknown or endless. A damaged file
        may have fewer, and for an MKV or WebM file the number is estimated from its length until
        all of it has been read.
    times
        What is known of the frames' times.
    line_step
        Columns of the camera from one column of a frame to the next: 2 for the fields of an
        interlaced film, of which each is a frame of its own.
    path
        The file, None if the film is simulated.
    scene, recording
        Scene and recording with which a film was simulated, also if read from a file; None for
        other films. They are the truth with which a reading is compared; a reader does not use
        them.
    """

    title: str
    shape: tuple[int, int]
    frame_rate: float | None
    frame_count: int | None
    times: FilmTimes = FilmTimes()
    line_step: int = 1
    path: Path | None = None
    scene: Scene | None = None
    recording: Recording | None = None

    @property
    def simulated(self) -> bool:
        """Whether its frames are simulated on demand."""
        return self.path is None

    @property
    def problem(self) -> str | None:
        """A sentence if the film has so far proved damaged or too short; else None."""
        return None

    @abstractmethod
    def frames(self, first: int = 0) -> Iterator[VideoFrame]:
        """Yield the frames in order, starting with number ``first``.

        Raises
        ------
        ParameterError
            ``first`` is not a whole number from 0.
        VideoError
            The file can no longer be read.
        """

    @abstractmethod
    def frame(self, index: int) -> VideoFrame:
        """Return one frame; the frame after the last returned one takes the least time.

        Raises
        ------
        ParameterError
            The film has no frame with that number.
        VideoError
            The file can no longer be read.
        """

    def __iter__(self) -> Iterator[VideoFrame]:
        return self.frames()
