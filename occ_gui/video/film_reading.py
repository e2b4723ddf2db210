"""Result of reading a film, ready to show: marks and their look, text, facts and sentences."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPalette, QPen

from occ_gui.widgets.plot import DrawSample, LineLegend
from occ_gui.widgets.state_look import State, colours_of
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
    forward_steps = steps[steps > 0.0]
    usual = float(np.median(forward_steps)) if forward_steps.size else last
    # Nothing is known about the time in a gap.
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
    answer: str = ""  # what was read, in one line
    facts: tuple[Fact, ...] = ()
    sentences: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class MarkLook:
    state: State
    pattern: Qt.BrushStyle
    height: float  # as a fraction of its row; tells states apart in narrow marks
    name: str
    meaning: str
    spoken: str  # what a screen reader says about a frame


_Pattern = Qt.BrushStyle
LOOKS = {
    MarkState.READ: MarkLook(
        State.GOOD, _Pattern.SolidPattern, 1.0, "read",
        "A frame with a known place, or a packet that agrees with all others.", "read",
    ),
    MarkState.UNCHECKED: MarkLook(
        State.DOUBTFUL, _Pattern.Dense5Pattern, 0.65, "not checked",
        "Read, but it is unknown whether it is right, or where it belongs.", "read, not checked",
    ),
    MarkState.LOST: MarkLook(
        State.BAD, _Pattern.BDiagPattern, 0.35, "lost", "Not read, or misread.", "lost"
    ),
    MarkState.PENDING: MarkLook(
        State.NEUTRAL, _Pattern.NoBrush, 1.0, "to come", "Not examined yet.", "not examined yet"
    ),
}  # fmt: skip
"""In the order of the legend."""

_SAMPLE = QSize(16, 14)
_LEAST_OUTLINE = 4.0  # least width in pixels of a mark that is drawn with an outline


def brush_of(state: MarkState, palette: QPalette) -> QBrush:
    """Return the brush for marks of a state; an empty brush for frames to come."""
    return QBrush(colours_of(LOOKS[state].state, palette).ink, LOOKS[state].pattern)


def draw_mark(painter: QPainter, place: QRectF, state: MarkState, palette: QPalette) -> None:
    height = place.height() * LOOKS[state].height
    bar = QRectF(place.left(), place.bottom() - height, place.width(), height)
    brush = brush_of(state, palette)
    ink = brush.color()
    if state is MarkState.PENDING:
        line = QColor(ink)
        line.setAlpha(110)
        painter.setPen(QPen(line, 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
    else:
        is_wide = bar.width() >= _LEAST_OUTLINE
        painter.setPen(QPen(ink, 1) if is_wide else Qt.PenStyle.NoPen)
        painter.setBrush(brush if is_wide else QBrush(ink))
    if bar.width() >= _LEAST_OUTLINE:
        bar.adjust(0.5, 0.5, -0.5, -0.5)
    painter.drawRect(bar)


class MarkLegend(LineLegend):
    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName("Legend of the timeline")
        for state, look in LOOKS.items():
            self.add_sample(state.name, _sample_of(state), _SAMPLE, look.name, look.meaning)


def _sample_of(state: MarkState) -> DrawSample:
    def draw(painter: QPainter, place: QRectF, palette: QPalette) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        draw_mark(painter, place, state, palette)

    return draw
