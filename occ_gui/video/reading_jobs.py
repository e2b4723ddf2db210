"""Jobs of a film's reading: go through its frames, and say again and again what is known so far."""

from collections import deque
from dataclasses import dataclass
from time import monotonic

import numpy as np

import occ_model as occ
from occ_gui.background.cancellable import Report
from occ_gui.video.film_reading import Figure, FilmReading
from occ_gui.video.marks import MarkState
from occ_model.results import DecodeResult
from occ_model.results.video import Video
from occ_model.scene.scene import Scene

_INTERVAL = 0.1
"""Seconds between two reports, so that the window can draw each of them."""

_LIVE_INTERVAL = 0.03
"""The same for a camera, whose picture is shown with each."""

MOST_LIVE = 900
"""Frames of a live film that are remembered: half a minute of 30 a second."""


@dataclass(frozen=True, eq=False, slots=True)
class ReadingRequest:
    """A film that is to be read.

    Parameters
    ----------
    film
        The film.
    scene
        What the receiver knows of it.
    is_live
        Whether it has no end, so that only its last frames are remembered.
    """

    film: Video
    scene: Scene
    is_live: bool = False


class _Collected:
    """What has been read so far, frame by frame."""

    def __init__(self, request: ReadingRequest) -> None:
        most = MOST_LIVE if request.is_live else None
        self._film, self._scene = request.film, request.scene
        self._times: deque[float] = deque(maxlen=most)
        self._states: deque[int] = deque(maxlen=most)
        self._texts: deque[str] = deque(maxlen=most)

    def add(self, time: float, decoded: DecodeResult) -> None:
        self._times.append(time)
        self._states.append(self._state_of(decoded))
        text = decoded.payload or ("" if decoded.code is None else str(decoded.code))
        if decoded.failure is None and text:
            self._texts.append(text)

    def _state_of(self, decoded: DecodeResult) -> MarkState:
        if decoded.failure is not None or decoded.code is None:
            return MarkState.LOST
        truth = self._film.scene
        if truth is None or truth.transmitter.pattern:
            return MarkState.UNCHECKED
        is_right = tuple(decoded.bits.tolist()) == truth.transmitter.payload_bits
        return MarkState.READ if is_right else MarkState.LOST

    def reading(self) -> FilmReading:
        states = np.array(self._states, dtype=np.uint8)
        read = int(np.count_nonzero(states != MarkState.LOST))
        figures = (Figure("Frames read", f"{read} of {len(states)}", "Frames with a code."),)
        problem = self._film.problem
        return FilmReading(
            times=np.array(self._times, dtype=np.float64),
            states=states,
            text="\n".join(self._texts),
            figures=figures if len(states) else (),
            sentences=(problem,) if problem else (),
        )


def read_film(request: ReadingRequest, report: Report) -> FilmReading:
    """Read a film from its first frame to its last; reports are FilmReadings.

    Raises
    ------
    OccError
        The film cannot be read any more.
    """
    collected, last = _Collected(request), monotonic()
    interval = _LIVE_INTERVAL if request.is_live else _INTERVAL
    for frame in request.film:
        report(None)
        collected.add(frame.time, occ.decode(frame.image, request.scene))
        if monotonic() - last >= interval:
            report(collected.reading())
            last = monotonic()
    return collected.reading()
