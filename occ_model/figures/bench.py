"""Draw the bench: bit error rates over the exposure, and over the signal-to-noise ratio."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model.figures.drawing import Drawing
from occ_model.scene.provenance import Provenance
from occ_model.study.bench.bench import HEADER, BenchPoint, BenchRequest, bench_scene, written

_MARKERS = ("o", "s", "^", "D", "v", "P", "X")

_ARROW = 0.4
"""Length of the arrow down from an upper end, as a share of it."""


def write_bench(folder: Path, request: BenchRequest, points: Sequence[BenchPoint]) -> None:
    """Write the figure as PDF and PNG, and its points as CSV.

    Raises
    ------
    OutputError
        A file cannot be written.
    """
    drawing = bench_drawing(request, points)
    scenes = {
        scheme: bench_scene(scheme, request.payload_bits, 1.0, request.rows_a_symbol)
        for scheme in request.schemes
    }
    provenance = Provenance(drawing.title, scenes, request.seed, _notes(request))
    for ending in (".pdf", ".png", ".csv"):
        drawing.write(folder / f"{drawing.name}{ending}", provenance)


def bench_drawing(request: BenchRequest, points: Sequence[BenchPoint]) -> Drawing:
    """Draw the bit error rates of a request."""
    title = "Bit error rates over exposure and noise"
    return Drawing("bench", title, lambda: _draw(request, points), HEADER, lambda: written(points))


def _notes(request: BenchRequest) -> tuple[str, ...]:
    return (
        f"{request.rows_a_symbol:g} rows a symbol, payloads of {request.payload_bits} bits, at "
        f"least {request.bits} bits a point",
        f"over the exposure at {request.at_decibels:g} dB, over the noise at an exposure of "
        f"{request.at_exposure:g} symbols",
    )


def _draw(request: BenchRequest, points: Sequence[BenchPoint]) -> Figure:
    figure = Figure(figsize=(7.2, 3.6))
    left, right = figure.subplots(1, 2, sharey=True)
    for ax, axis in ((left, "exposure"), (right, "noise")):
        _draw_axis(ax, axis, [point for point in points if point.axis == axis])
        ax.set_yscale("log")
        ax.grid(linewidth=0.3)
    left.set_xlabel("exposure (symbols)")
    left.set_ylabel("bit error rate")
    left.set_title(f"{request.at_decibels:g} dB", fontsize=9)
    right.set_xlabel("signal-to-noise ratio (dB)")
    right.set_title(f"exposure of {request.at_exposure:g} symbols", fontsize=9)
    lowest = min((point.errors.rate or point.errors.high for point in points), default=1.0)
    left.set_ylim(0.3 * lowest, 1.5)
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False, fontsize=7)
    return figure


def _draw_axis(ax: Axes, axis: str, points: Sequence[BenchPoint]) -> None:
    curves: dict[tuple[str, str], list[BenchPoint]] = {}
    for point in points:
        curves.setdefault((point.scheme, point.errors.decoder), []).append(point)
    for number, ((scheme, decoder), some) in enumerate(curves.items()):
        at = [point.exposure if axis == "exposure" else point.decibels for point in some]
        errors = [point.errors for point in some]
        without = [not one.errors for one in errors]
        # Without an error only the upper end is known: an arrow points down from it.
        rates = [one.rate or one.high for one in errors]
        low = [rate * _ARROW if one.low == 0.0 else rate - one.low
               for rate, one in zip(rates, errors, strict=True)]  # fmt: skip
        high = [one.high - rate for rate, one in zip(rates, errors, strict=True)]
        ax.errorbar(
            at, rates, [low, high], uplims=without, label=f"{scheme}, {decoder}",
            marker=_MARKERS[number % len(_MARKERS)], markersize=4, linewidth=1.0, capsize=2,
        )  # fmt: skip
