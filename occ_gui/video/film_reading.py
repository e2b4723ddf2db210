"""Result of reading a film, ready to show: marks of the timeline, text, facts and sentences."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.results.fact import Fact
from occ_model.video.frame_times import LEAST_BREAK


class MarkState(IntEnum):
    PENDING = 0
    READ = 1  # a frame with a known place in what is sent, or a packet that agrees with all others
    UNCHECKED = 2  # read, but it is unknown whether it is right, or where it belongs
    LOST = 3  # not read, or read wrong


@dataclass(frozen=True, eq=False, slots=True)
class Marks:
    """Marks in the order of the film, usually that of time.

    Each attribute has the shape (marks,).
    """

    # When each mark begins and ends, in seconds
    starts: FloatArray = field(default_factory=lambda: np.zeros(0))
    ends: FloatArray = field(default_factory=lambda: np.zeros(0))
    # The :class:`MarkState` of each mark
    states: ByteArray = field(default_factory=lambda: np.zeros(0, dtype=np.uint8))

    def __len__(self) -> int:
        return len(self.starts)

    @property
    def extent(self) -> tuple[float, float]:
        """Start of the first mark and end of the last mark, in seconds."""
        return (float(self.starts.min()), float(self.ends.max())) if len(self) else (0.0, 0.0)

    def count_states(self, edges: FloatArray) -> IndexArray:
        """Count the marks of each state that begin between rising edges, shape (bins, states)."""
        counts = [
            np.histogram(self.starts[self.states == state], bins=edges)[0] for state in MarkState
        ]
        return np.stack(counts, axis=1).astype(np.int64)


def frame_marks(times: Sequence[float] | FloatArray, states: ByteArray, last: float) -> Marks:
    """Return a mark for each frame, which ends where the next frame begins.

    A mark before a gap or a jump in the times has the usual length. ``last``: seconds of the last
    frame.
    """
    starts = np.asarray(times, dtype=np.float64)
    if not len(starts):
        return Marks()
    steps = np.append(np.diff(starts), last)
    ahead = steps[steps > 0.0]
    usual = float(np.median(ahead)) if ahead.size else last
    # What lies in a gap of the times is unknown.
    steps = np.where((steps < 0.0) | (steps > LEAST_BREAK * usual), usual, steps)
    return Marks(starts, starts + steps, states)


@dataclass(frozen=True, eq=False, slots=True)
class FilmReading:
    # Shape (frames,): when the frames that were examined began, in seconds
    times: FloatArray = field(default_factory=lambda: np.zeros(0))
    # Shape (frames,): the :class:`MarkState` of each frame
    states: ByteArray = field(default_factory=lambda: np.zeros(0, dtype=np.uint8))
    packets: Marks = field(default_factory=Marks)
    text: str = ""
    facts: tuple[Fact, ...] = ()
    sentences: tuple[str, ...] = ()
