"""Draw the steps of decoding for print: signal, threshold, chips, and run lengths or templates."""

from collections.abc import Iterable, Sequence
from itertools import zip_longest
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.arrays import FloatArray
from occ_model.errors import capitalize, make_printable, one_line
from occ_model.figures.caption import caption, write_caption
from occ_model.figures.drawing import THRESHOLD, Drawing
from occ_model.results.decoding import Cause, DecodeResult, symptom
from occ_model.scene.declaration import in_sentence
from occ_model.scene.scene import Scene

_ABOVE_LEGEND = 20  # points from the axes to the title
_LONGEST_PAYLOAD = 40  # characters of a payload that the title shows

_SIGNAL: dict[str, Any] = {"color": colours.SIMULATION, "linestyle": "-"}
_MODEL: dict[str, Any] = {"color": colours.PHOTO, "linestyle": ":"}

_SPLITS: tuple[dict[str, Any], ...] = (
    {"color": "0.4", "linestyle": "--"},
    {"color": colours.SIMULATION, "linestyle": "-."},
)  # for dark and for lit runs, in the colours of their bars


def decode_drawing(scene: Scene, result: DecodeResult, cause: Cause | None = None) -> Drawing:
    """Draw the steps of decoding up to the code or the step that failed, and name the cause."""
    message = result.failure or f"{_describe_read(result)} read by the {result.decoder} decoder"
    if cause is not None:
        message = f"{capitalize(cause.what)}: {in_sentence(symptom(message))}"
    message = make_printable(message)

    def draw() -> Figure:
        figure = Figure(figsize=(7.2, 4.2))
        upper, lower = figure.subplots(2, 1)
        _draw_signal(upper, result)
        if result.folded is not None and result.model is not None:
            _draw_folded(lower, result.folded, result.model)
        else:
            _draw_runs(lower, result)
        upper.set_title(message, fontsize=8, loc="left", pad=_ABOVE_LEGEND, parse_math=False)
        write_caption(figure, scene)
        return figure

    signal = [] if result.signal is None else result.signal.tolist()
    starts = [] if result.chip_starts is None else result.chip_starts.tolist()
    chips = result.chips.tolist()

    def rows() -> Iterable[tuple[object, ...]]:
        columns = range(len(signal))
        yield from zip_longest(
            in_picture(columns), columns, signal, in_picture(starts), starts, chips
        )

    def in_picture(places: Sequence[float]) -> list[float | None]:
        if result.region is None:
            return [None] * len(places)
        return [result.region.first_column + place for place in places]

    header = (
        "column of the picture", "column of the region", "signal (grey level)",
        "chip from column of the picture", "chip from column of the region", "chip",
    )  # fmt: skip
    title = f"Decoding, {message}: {caption(scene)}"
    return Drawing(f"decoding-{result.decoder}", title, draw, header, rows)


def _describe_read(result: DecodeResult) -> str:
    if result.payload:
        return f"“{one_line(result.payload, _LONGEST_PAYLOAD)}”"
    return f"code {result.code}"


def _draw_signal(ax: Axes, result: DecodeResult) -> None:
    ax.set(xlabel="column of the region", ylabel="grey level")
    if result.signal is None:
        return
    ax.plot(result.signal, linewidth=0.8, label="signal", **_SIGNAL)
    if result.threshold is not None:
        ax.axhline(result.threshold, label="threshold", **THRESHOLD)
    if result.chip_starts is not None and result.chip_length is not None:
        lit = result.chip_starts[result.chips.astype(bool)].tolist()
        bars = [(start, result.chip_length) for start in lit]
        low = float(result.signal.min())
        height = 0.06 * max(float(np.ptp(result.signal)), 1.0)
        ax.broken_barh(bars, (low - 2.0 * height, height), color="0.3", label="chips: lit")
    _add_legend(ax, 3)


def _add_legend(ax: Axes, columns: int) -> None:
    """Put the legend above the axes, where it covers nothing."""
    ax.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), fontsize=7, ncols=columns, frameon=False
    )


def _draw_folded(ax: Axes, folded: FloatArray, model: FloatArray) -> None:
    ax.plot(folded, linewidth=1.0, label="signal, folded over one packet", **_SIGNAL)
    # The model's dots are wider than the signal's line, which covers them if the code is right.
    ax.plot(model, linewidth=2.5, label="the code's forward model", **_MODEL)
    ax.set(xlabel="eighth of a chip", ylabel="lit fraction")
    _add_legend(ax, 2)


def _draw_runs(ax: Axes, result: DecodeResult) -> None:
    ax.set(xlabel="length of a run (columns)", ylabel="runs")
    if result.histograms is None:
        return
    hatches = ("", "////")
    for value, histogram in enumerate(result.histograms):
        lengths = np.flatnonzero(histogram.counts)
        runs = ("dark runs", "lit runs")[value]
        ax.bar(
            lengths + (0.2 if value else -0.2), histogram.counts[lengths], width=0.4, label=runs,
            hatch=hatches[value], edgecolor="0.2", linewidth=0.4,
            color=("0.6", colours.SIMULATION)[value],
        )  # fmt: skip
        if histogram.split is not None:
            place = histogram.split + (0.5 if value else 0.4)
            ax.axvline(place, label=f"split of the {runs}", linewidth=0.9, **_SPLITS[value])
    _add_legend(ax, 4)
