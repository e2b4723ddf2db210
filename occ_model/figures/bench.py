"""Draw the bench: bit error rates and bits a second against exposure and against noise."""

from collections.abc import Sequence
from functools import partial
from math import nan
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from occ_model import colours
from occ_model.errors import inflect
from occ_model.figures.drawing import PRINT_ENDINGS, Drawing, write_all
from occ_model.results.bit_errors import HEADER, BenchBounds, BenchPoint, BenchRequest, table_rows
from occ_model.scene.provenance import Provenance
from occ_model.study.bench.bench import bench_bounds, bench_scene
from occ_model.study.bit_error_rate import check_frame_rate

_TITLE = "Bit error rates and bits a second over exposure and noise"
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")

# As in the window
_COLOURS = (colours.SIMULATION, colours.BAND, colours.PHOTO, colours.REGION, colours.NOISE)

_ARROW = 0.5  # length of the arrow down from an upper bound, as a fraction of the bound

_AXES = ("exposure", "noise")
_BOUND: dict[str, Any] = {"color": "0.35", "linestyle": "--", "linewidth": 1.0}
_NULL: dict[str, Any] = {"color": "0.6", "linestyle": ":", "linewidth": 1.0}


def write_bench(
    folder: Path, request: BenchRequest, points: Sequence[BenchPoint], frames_a_second: float
) -> None:
    drawing = bench_drawing(request, points, frames_a_second)
    provenance = bench_provenance(request, frames_a_second)
    write_all(folder, [drawing], lambda _: provenance, PRINT_ENDINGS)


def bench_provenance(request: BenchRequest, frames_a_second: float, date: str = "") -> Provenance:
    scenes = {scheme: bench_scene(request, scheme) for scheme in request.schemes}
    return Provenance(_TITLE, scenes, request.seed, _notes(request, frames_a_second), date)


def bench_drawing(
    request: BenchRequest, points: Sequence[BenchPoint], frames_a_second: float
) -> Drawing:
    """Draw the measured points of a request and the theoretical bounds."""
    check_frame_rate(bench_scene(request, request.schemes[0]), frames_a_second)
    bounds = bench_bounds(request)
    return Drawing(
        "bench",
        _TITLE,
        lambda: _draw(request, points, bounds, frames_a_second),
        HEADER,
        lambda: table_rows(points, frames_a_second),
        partial(bench_provenance, request, frames_a_second),
    )


def _notes(request: BenchRequest, frames_a_second: float) -> tuple[str, ...]:
    return (
        f"{inflect(request.rows_a_symbol, 'row')} a symbol (the row rate allows 1 or more), "
        f"{inflect(request.rows, 'row')} a picture, payloads of "
        f"{inflect(request.payload_bits, 'bit')}, at least "
        f"{inflect(request.bits, 'bit')} a point",
        f"over the exposure at {request.at_decibels:g} dB, over the noise at an exposure of "
        f"{inflect(request.at_exposure, 'symbol')}",
        f"{inflect(frames_a_second, 'picture')} a second, one payload each",
    )


def _draw(
    request: BenchRequest,
    points: Sequence[BenchPoint],
    bounds: BenchBounds,
    frames_a_second: float,
) -> Figure:
    figure = Figure(figsize=(7.2, 5.6))
    panels = figure.subplots(2, 2, sharex="col", sharey="row")
    for column, axis in enumerate(_AXES):
        axis_points = [point for point in points if point.axis == axis]
        rates, bits = panels[0][column], panels[1][column]
        for number, (label, curve) in enumerate(_group_curves(axis_points).items()):
            _draw_rates(rates, number, label, curve)
            _draw_bits(bits, number, curve, frames_a_second)
        bound_places, bounds_of_bits = bounds.most_bits[axis]
        bits.plot(
            bound_places,
            [frames_a_second * bits_a_picture for bits_a_picture in bounds_of_bits],
            **_BOUND,
        )
        rates.set_yscale("log")
        # The scale is linear below a bit a picture, to include 0.
        bits.set_yscale("symlog", linthresh=frames_a_second)
        bits.set_ylim(bottom=0.0)
        for ax in (rates, bits):
            ax.grid(linewidth=0.3)
    for ax in (panels[0][0], panels[1][0]):
        for null in bounds.nulls:
            ax.axvline(null, **_NULL)
    _name_axes(figure, panels, request)
    lowest = min((point.errors.rate or point.errors.high for point in points), default=1.0)
    panels[0][0].set_ylim(0.3 * lowest, 1.5)
    return figure


def _name_axes(figure: Figure, panels: Sequence[Sequence[Axes]], request: BenchRequest) -> None:
    (rates, rates_by_noise), (bits, bits_by_noise) = panels
    rates.set_ylabel("bit error rate")
    bits.set(xlabel="exposure (symbols)", ylabel="bits a second")
    bits_by_noise.set_xlabel("signal-to-noise ratio (dB)")
    rates.set_title(f"{request.at_decibels:g} dB", fontsize=9)
    rates_by_noise.set_title(f"exposure of {inflect(request.at_exposure, 'symbol')}", fontsize=9)
    curves = dict(zip(*reversed(rates.get_legend_handles_labels()), strict=True))
    curves |= dict(zip(*reversed(rates_by_noise.get_legend_handles_labels()), strict=True))
    lines = {
        "nulls of alternating chips": Line2D([], [], **_NULL),
        "most that Gaussian light carries": Line2D([], [], **_BOUND),
    }
    legend = {**curves, **lines}
    figure.legend(
        legend.values(),
        legend.keys(),
        loc="outside upper center",
        ncols=3,
        frameon=False,
        fontsize=7,
    )


def _group_curves(points: Sequence[BenchPoint]) -> dict[str, list[BenchPoint]]:
    curves: dict[str, list[BenchPoint]] = {}
    for point in points:
        curves.setdefault(f"{point.scheme}, {point.errors.decoder}", []).append(point)
    failed = " (a plug-in failed)"
    return {
        label + failed * any(point.errors.faults for point in curve): curve
        for label, curve in curves.items()
    }


def _draw_rates(ax: Axes, number: int, label: str, points: Sequence[BenchPoint]) -> None:
    places = [point.place for point in points]
    errors = [point.errors for point in points]
    rates = [error.rate or nan for error in errors]
    # A logarithmic axis has no place for an interval that ends at 0.
    low = [rate * (1.0 - _ARROW) if error.low == 0.0 else rate - error.low
           for rate, error in zip(rates, errors, strict=True)]  # fmt: skip
    high = [error.high - rate for rate, error in zip(rates, errors, strict=True)]
    style = _curve_style(number)
    ax.errorbar(places, rates, [low, high], label=label, linewidth=1.0, **style)
    # Without any error there is only an upper bound, drawn without a line to the rates.
    upper_bounds = [nan if error.errors else error.high for error in errors]
    arrows = [_ARROW * error.high for error in errors]
    ax.errorbar(
        places,
        upper_bounds,
        [arrows, arrows],
        uplims=True,
        linestyle="",
        **style,
        markerfacecolor="none",
    )


def _draw_bits(ax: Axes, number: int, points: Sequence[BenchPoint], frames_a_second: float) -> None:
    bits = [point.errors.bits_a_second(frames_a_second) for point in points]
    ends = [point.errors.bits_a_second_interval(frames_a_second) for point in points]
    error = [
        [max(value - low, 0.0) for value, (low, _) in zip(bits, ends, strict=True)],
        [max(high - value, 0.0) for value, (_, high) in zip(bits, ends, strict=True)],
    ]
    places = [point.place for point in points]
    ax.errorbar(places, bits, error, linewidth=1.0, clip_on=False, **_curve_style(number))


def _curve_style(number: int) -> dict[str, Any]:
    marker = _MARKERS[number % len(_MARKERS)]
    colour = _COLOURS[number % len(_COLOURS)]
    return {"color": colour, "marker": marker, "markersize": 4, "capsize": 2}
