"""Parts of figures: ends of intervals, symbols, and what a report has room for."""

from types import SimpleNamespace
from unittest.mock import Mock

import numpy as np
import pytest

from occ_model.figures import lesson_steps
from occ_model.figures.bench import _draw_bits
from occ_model.figures.circuit_symbols import transistor


def test_the_bits_of_a_bench_are_drawn_with_both_ends_of_their_intervals() -> None:
    axes = Mock()
    points = [
        SimpleNamespace(
            place=place,
            errors=SimpleNamespace(
                bits_a_second=lambda _frames, most=most: most - 4.0,
                bits_a_second_interval=lambda _frames, most=most: (most - 6.0, most),
            ),
        )
        for place, most in ((1.0, 9.0), (2.0, 12.0))
    ]
    _draw_bits(axes, 0, points, 30.0)  # type: ignore[arg-type]
    at, bits, (below, above) = axes.errorbar.call_args.args
    assert (at, bits) == ([1.0, 2.0], [5.0, 8.0])
    assert (below, above) == ([2.0, 2.0], [4.0, 4.0])


def test_the_arrow_of_a_transistor_points_straight_at_its_gate() -> None:
    axes = Mock()
    transistor(axes, 3.0, 7.0, "Q1")
    (arrow,) = axes.add_patch.call_args.args
    tip, *base = arrow.get_xy()[:3].tolist()
    assert tip[1] == 7.0
    assert base[0][0] == base[1][0] > tip[0] > 3.0
    assert np.mean([corner[1] for corner in base]) == pytest.approx(7.0)


@pytest.mark.parametrize(("top", "is_drawn"), [(0.5, True), (0.11, False)])
def test_a_report_shows_what_was_seen_where_it_has_room(
    monkeypatch: pytest.MonkeyPatch, top: float, is_drawn: bool
) -> None:
    draw = Mock()
    monkeypatch.setattr(lesson_steps, "draw_profile", draw)
    monkeypatch.setattr(lesson_steps, "_room", lambda _: 1.0)
    step = SimpleNamespace(match=None, scene="the scene")
    lesson_steps._draw_seen(Mock(), step, top, 0.1)  # type: ignore[arg-type]
    assert draw.called is is_drawn
