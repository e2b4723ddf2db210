"""Parts of figures: ends of intervals, symbols, and what a report has room for."""

from types import SimpleNamespace
from unittest.mock import Mock

import numpy as np
import pytest
from matplotlib.axis import Axis
from model.figures.test_as_stored import table_of

from occ_model.figures import lesson_report
from occ_model.figures.accuracy import _draw_part
from occ_model.figures.bench import _draw_bits
from occ_model.figures.decoding import _draw_signal
from occ_model.figures.paper import _padded, _shown_columns
from occ_model.figures.sweep import _axis_label, sweep_drawing
from occ_model.figures.window_panes import _show
from occ_model.results.accuracy import ACCURACY_PARTS, CHAINED_PARTS
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene


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


@pytest.mark.parametrize(("left", "first"), [(3.4, 4), (5.0, 5), (-7.2, 0)])
def test_a_profile_begins_with_the_first_column_whose_middle_shows_the_panel(
    left: float, first: int
) -> None:
    frame = SimpleNamespace(corners=np.array([[left, 2.0], [300.0, 2.0]]), profile=np.zeros(4000))
    shown, end = _shown_columns(Scene(), frame)  # type: ignore[arg-type]
    assert shown == first
    assert first < end <= 4000


@pytest.mark.parametrize("part", ACCURACY_PARTS)
def test_only_points_that_follow_one_another_are_joined_by_a_line(part: str) -> None:
    axes = Mock()
    points = [
        SimpleNamespace(name=str(place), seconds=1e-3 * place, error=0.1 / place, current=False)
        for place in (1, 2, 3)
    ]
    _draw_part(axes, part, points)  # type: ignore[arg-type]
    styles = [call.kwargs.get("linestyle") for call in axes.plot.call_args_list]
    assert ("-" in styles) == (part in CHAINED_PARTS)


@pytest.mark.parametrize("swing", [0.1, 4.0, 200.0])
def test_the_bars_of_lit_chips_stand_just_below_the_signal(swing: float) -> None:
    axes = Mock()
    signal = 20.0 + swing * np.tile([0.0, 1.0], 4)
    chips = np.array([0, 1], dtype=np.uint8)
    result = DecodeResult(
        "own", signal=signal, chips=chips, chip_starts=np.array([0.0, 4.0]), chip_length=4.0
    )
    _draw_signal(axes, result)
    _, (low, height) = axes.broken_barh.call_args.args
    assert 0.03 <= height / max(swing, 1.0) <= 0.1
    assert 0.0 < 20.0 - (low + height) <= 1.01 * height


def test_a_picture_is_drawn_with_each_pixel_round_its_number() -> None:
    axes = Mock()
    _show(axes, np.zeros((30, 40), dtype=np.uint8))
    assert axes.imshow.call_args.kwargs["extent"] == (-0.5, 39.5, 29.5, -0.5)


@pytest.mark.parametrize(
    ("name", "unit", "label"),
    [("edge_time", "µs", "LED"), ("distance", "m", "distance"), ("iso", "", "ISO")],
)
def test_the_label_of_an_axis_begins_small_but_for_abbreviations(
    name: str, unit: str, label: str
) -> None:
    shown = _axis_label(name, unit)
    assert shown.startswith(label)
    assert shown.endswith(f"({unit})") == bool(unit)


def test_a_report_says_what_became_of_an_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lesson_report, "_draw_seen", Mock())
    figure = Mock()
    answer = SimpleNamespace(text="12", sentence="That is what the picture shows.")
    step = SimpleNamespace(
        question="How many?", answer="Twelve.", with_unit=lambda text: f"{text} ms", own_photo=True
    )
    for given in (answer, None):
        each = SimpleNamespace(step=step, answer=given, match=None, photo=None, scene=Scene())
        lesson_report._draw_step(figure, 1, each, 0.9, 0.5)  # type: ignore[arg-type]
        texts = [str(call.args[2]).replace("\n", " ") for call in figure.text.call_args_list]
        assert (answer.sentence in texts) == (given is not None)
        figure.text.reset_mock()


@pytest.mark.parametrize(("top", "is_drawn"), [(0.5, True), (0.11, False)])
def test_a_report_shows_what_was_seen_where_it_has_room(
    monkeypatch: pytest.MonkeyPatch, top: float, is_drawn: bool
) -> None:
    draw = Mock()
    monkeypatch.setattr(lesson_report, "draw_profile", draw)
    monkeypatch.setattr(lesson_report, "_room", lambda _: 1.0)
    step = SimpleNamespace(match=None, scene="the scene")
    lesson_report._draw_seen(Mock(), step, top, 0.1)  # type: ignore[arg-type]
    assert draw.called is is_drawn


@pytest.mark.parametrize("length", [2, 4, 9])
def test_a_photos_profile_has_the_columns_of_the_simulated_one(length: int) -> None:
    padded = _padded(np.array([1.0, 2.0, 3.0, 4.0]), length)
    assert len(padded) == length
    assert padded[:4].tolist() == [1.0, 2.0, 3.0, 4.0][:length]
    assert np.isnan(padded[4:]).all()


FREQUENCIES = np.geomspace(0.97e3, 31e3, 13).tolist()
EXPOSURES = np.linspace(33e-6, 97e-6, 11).tolist()


def values_at(axis: Axis, cells: list[float]) -> dict[float, float]:
    """Give for every label the value that its place among the cells stands for."""
    numbers = np.arange(len(cells), dtype=np.float64)
    return {
        float(tick.get_text()): float(np.interp(place, numbers, cells))
        for tick, place in zip(axis.get_ticklabels(), axis.get_ticklocs(), strict=True)
    }


def test_numbers_are_round_and_stand_where_their_values_are() -> None:
    axes = {"switching_frequency": tuple(FREQUENCIES), "exposure_time": tuple(EXPOSURES)}
    ax = sweep_drawing(table_of(axes)).draw().axes[0]
    kilohertz = values_at(ax.xaxis, np.log(np.array(FREQUENCIES) / 1e3).tolist())
    assert list(kilohertz) == [1.0, 2.0, 5.0, 10.0, 20.0]
    assert np.exp(list(kilohertz.values())) == pytest.approx(list(kilohertz), rel=1e-9)
    microseconds = values_at(ax.yaxis, (np.array(EXPOSURES) * 1e6).tolist())
    assert list(microseconds) == [40.0, 50.0, 60.0, 70.0, 80.0, 90.0]
    assert list(microseconds.values()) == pytest.approx(list(microseconds), rel=1e-9)
