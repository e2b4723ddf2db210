"""Reading of a film, ready to be shown: marks of the timeline, text, facts and sentences."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.results.fact import Fact
from occ_model.video.frame_times import LEAST_BREAK


class MarkState(IntEnum):
    PENDING = 0
    READ = 1  # read: a frame whose place in what is sent is known, a packet that is as all others
    UNCHECKED = 2  # read, but nothing says whether it is right, or where it belongs
    LOST = 3  # not read, or read wrong


@dataclass(frozen=True, eq=False, slots=True)
class Marks:
    """Marks in the order of time, unless the film's own times are not."""

    # Shape (marks,): when each begins and ends, in seconds
    starts: FloatArray = field(default_factory=lambda: np.zeros(0))
    ends: FloatArray = field(default_factory=lambda: np.zeros(0))
    # Shape (marks,): A :class:`MarkState` each
    states: ByteArray = field(default_factory=lambda: np.zeros(0, dtype=np.uint8))

    def __len__(self) -> int:
        return len(self.starts)

    @property
    def extent(self) -> tuple[float, float]:
        """Start of the first mark and end of the last one, in seconds."""
        return (float(self.starts.min()), float(self.ends.max())) if len(self) else (0.0, 0.0)

    def counted(self, edges: FloatArray) -> IndexArray:
        """Count the marks of each state that begin between rising edges, shape (bins, states)."""
        counts = [
            np.histogram(self.starts[self.states == state], bins=edges)[0] for state in MarkState
        ]
        return np.stack(counts, axis=1).astype(np.int64)


def frame_marks(times: Sequence[float] | FloatArray, states: ByteArray, last: float) -> Marks:
    """Return a mark for each frame until the next, if soon; ``last``: the last one's seconds."""
    starts = np.asarray(times, dtype=np.float64)
    if not len(starts):
        return Marks()
    steps = np.append(np.diff(starts), last)
    ahead = steps[steps > 0.0]
    usual = float(np.median(ahead)) if ahead.size else last
    # Where the times jump nobody knows what was between.
    steps = np.where((steps < 0.0) | (steps > LEAST_BREAK * usual), usual, steps)
    return Marks(starts, starts + steps, states)


@dataclass(frozen=True, eq=False, slots=True)
class FilmReading:
    # Shape (frames,): when the frames that were looked at began, in seconds
    times: FloatArray = field(default_factory=lambda: np.zeros(0))
    # Shape (frames,): A :class:`MarkState` each
    states: ByteArray = field(default_factory=lambda: np.zeros(0, dtype=np.uint8))
    packets: Marks = field(default_factory=Marks)
    text: str = ""
    facts: tuple[Fact, ...] = ()
    sentences: tuple[str, ...] = ()
