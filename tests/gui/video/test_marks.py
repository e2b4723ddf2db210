"""Marks of a timeline: counted in bins, none is lost and none counted twice."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occ_gui.video.marks import Marks, MarkState, frame_marks
from occ_gui.video.timeline import TimelineScale, tick_step


@given(st.lists(st.sampled_from(list(MarkState)), min_size=1, max_size=300), st.integers(1, 40))
def test_bins_hold_each_mark_once(states: list[MarkState], bins: int) -> None:
    times = np.arange(len(states)) / 30.0
    marks = frame_marks(times, np.array(states, dtype=np.uint8), 1.0 / 30.0)
    scale = TimelineScale.of(marks)
    counts = marks.counted(np.linspace(scale.first, scale.last, bins + 1))
    assert counts.shape == (bins, len(MarkState))
    assert counts.sum(axis=0).tolist() == [states.count(state) for state in MarkState]


def test_each_frame_lasts_until_the_next_one() -> None:
    marks = frame_marks([0.0, 0.03, 0.07], np.zeros(3, dtype=np.uint8), 0.04)
    assert marks.ends.tolist() == pytest.approx([0.03, 0.07, 0.11])
    assert not len(frame_marks([], np.zeros(0, dtype=np.uint8), 0.04))
    assert not len(Marks())


@given(st.floats(1e-4, 1e5), st.integers(100, 4000))
def test_ticks_are_apart_and_their_numbers_differ(span: float, width: int) -> None:
    step, digits = tick_step(span, width)
    assert step / span * width >= 79.0
    assert step / span * width <= 250.0
    first, second = f"{step:.{digits}f}", f"{2 * step:.{digits}f}"
    assert float(first) == pytest.approx(step)
    assert first != second


def test_shares_of_the_width_and_times_are_inverse() -> None:
    scale = TimelineScale(1.0, 3.0)
    assert scale.share(2.0) == 0.5
    assert scale.time(scale.share(2.7)) == pytest.approx(2.7)
