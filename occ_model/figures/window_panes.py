"""What the window shows of a scene, drawn for print: picture, profiles, decoding."""

from collections.abc import Iterable
from itertools import zip_longest
from typing import Any

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from occ_model import colours
from occ_model.arrays import ByteArray, FloatArray
from occ_model.figures.drawing import BAND, PHOTO, SIMULATION, Drawing
from occ_model.results import Comparison, DecodeResult, Frame, Region
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

_MOST_CELLS = 900
"""Cells a side that a printed picture has: more are no finer on paper."""

_NAMED = ("exposure_time", "switching_frequency", "readout_time", "distance")

_SIGNAL: dict[str, Any] = {"color": colours.SIMULATION, "linestyle": "-"}
_MODEL: dict[str, Any] = {"color": colours.PHOTO, "linestyle": ":"}
_THRESHOLD: dict[str, Any] = {"color": colours.THRESHOLD, "linestyle": "-.", "linewidth": 0.9}


def caption(scene: Scene) -> str:
    """Say in a line what scene a figure shows."""
    parts = []
    for name in _NAMED:
        declared = PARAMETERS[name]
        value = declared.format(scene.value(name))  # type: ignore[arg-type]
        parts.append(f"{declared.label.lower()} {value}")
    return ", ".join(parts)


def picture_drawing(
    frame: Frame, region: Region | None = None, photo: ByteArray | None = None
) -> Drawing:
    """Draw the simulated picture, with the decoder's region and a photo beside it.

    The table holds the picture's cells, the means of as many pixels as print does not tell apart.

    Parameters
    ----------
    frame
        The simulated picture.
    region
        The rectangle that was read, None where none was.
    photo : ndarray of uint8, shape (rows, columns), or None
        The photo.
    """
    cells, size = _cells(frame.image)

    def draw() -> Figure:
        pictures = [frame.image] if photo is None else [frame.image, photo]
        rows, columns = frame.image.shape
        figure = Figure(figsize=(3.6 * len(pictures), 0.9 + 3.1 * min(rows / columns, 1.6)))
        axes = figure.subplots(1, len(pictures), squeeze=False)[0]
        for ax, picture in zip(axes, pictures, strict=True):
            _show(ax, picture)
            ax.set_title("photo" if picture is photo else "simulation", fontsize=9)
        if region is not None:
            corner = (region.first_column - 0.5, region.first_row - 0.5)
            style: dict[str, Any] = {"fill": False, "linewidth": 1.0, "color": colours.REGION}
            axes[0].add_patch(Rectangle(corner, region.columns, region.rows, **style))
        figure.supxlabel(caption(frame.scene), fontsize=7)
        return figure

    def rows() -> Iterable[tuple[object, ...]]:
        for row, values in enumerate(cells.tolist()):
            yield (size * (row + 0.5) - 0.5, *values)

    columns = [f"column {size * (c + 0.5) - 0.5:g}" for c in range(cells.shape[1])]
    title = f"Simulated picture: {caption(frame.scene)}"
    return Drawing("picture", title, draw, ("row", *columns), rows)


def _cells(image: ByteArray) -> tuple[FloatArray, int]:
    """Average a picture's cells of so many pixels a side that print can hold them."""
    size = -(-max(image.shape) // _MOST_CELLS)
    rows, columns = image.shape[0] // size, image.shape[1] // size
    whole = image[: rows * size, : columns * size]
    # The mean of each cell: taking one pixel of it would show stripes that are not there.
    cells = cv2.resize(whole, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.asarray(cells, dtype=np.float64), size


def _show(ax: Axes, picture: ByteArray) -> None:
    rows, columns = picture.shape
    extent = (-0.5, columns - 0.5, rows - 0.5, -0.5)
    ax.imshow(_cells(picture)[0], cmap="gray", vmin=0, vmax=255, extent=extent)
    ax.set_xlabel("column")
    ax.set_ylabel("row")
    ax.tick_params(labelsize=7)


def profile_drawing(
    frame: Frame,
    band: FloatArray | None,
    undefined: str = "",
    comparison: Comparison | None = None,
    first: int = 0,
    last: int | None = None,
) -> Drawing:
    """Draw the column profiles, and what is left between photo and simulation under them.

    Parameters
    ----------
    frame
        The simulation.
    band : ndarray of float64, shape (columns,), or None
        The band model's profile, None where ``undefined`` says why there is none.
    undefined
        A sentence.
    comparison
        The photo's profile beside the simulated one, if there is a photo.
    first, last
        The columns to draw, from ``first`` to before ``last``; by default all. The table holds all.
    """
    lines: dict[str, FloatArray | None] = {
        "simulation": frame.profile,
        "band model": band,
        "photo": None if comparison is None else _placed(comparison, len(frame.profile)),
    }
    shown = {name: values for name, values in lines.items() if values is not None}
    styles = {"simulation": SIMULATION, "band model": BAND, "photo": PHOTO}

    def draw() -> Figure:
        figure = Figure(figsize=(7.2, 2.9 if comparison is None else 4.0))
        ratios = (1,) if comparison is None else (3, 1)
        axes = figure.subplots(
            len(ratios), 1, squeeze=False, sharex=True, gridspec_kw={"height_ratios": ratios}
        )[:, 0]
        part = slice(first, last)
        column = np.arange(len(frame.profile))[part]
        for name, values in shown.items():
            axes[0].plot(column, values[part], label=name, linewidth=1.1, **styles[name])
        axes[0].set_ylabel("grey level")
        axes[0].set_ylim(bottom=0)
        if undefined:
            axes[0].set_title(undefined, fontsize=7)
        if comparison is not None:
            residual = shown["photo"] - frame.profile
            axes[1].axhline(0.0, color="grey", linewidth=0.5)
            axes[1].plot(column, residual[part], linewidth=0.9, color=colours.PHOTO)
            axes[1].set_ylabel("photo less\nsimulation")
            message = f"correlation {comparison.correlation:.4f}, RMSE {comparison.rmse:.2f} levels"
            axes[1].set_title(message, fontsize=8)
        axes[-1].set_xlabel("column")
        figure.legend(loc="outside upper center", ncols=len(shown), frameon=False)
        figure.supxlabel(caption(frame.scene), fontsize=7)
        return figure

    def rows() -> Iterable[tuple[object, ...]]:
        values = [one.tolist() for one in shown.values()]
        yield from zip(range(len(frame.profile)), *values, strict=True)

    header = ("column", *(f"{name} (grey level)" for name in shown))
    return Drawing("profile", f"Column profile: {caption(frame.scene)}", draw, header, rows)


def _placed(comparison: Comparison, columns: int) -> FloatArray:
    """Give a photo's profile over all columns of the simulation, not a number beside it."""
    placed = np.full(columns, np.nan)
    first = comparison.first_column
    placed[first : first + len(comparison.photo)] = comparison.photo
    return placed


def decode_drawing(scene: Scene, result: DecodeResult) -> Drawing:
    """Draw how a decoder read the signal, as far as it came.

    Parameters
    ----------
    scene
        The scene.
    result
        What the decoder made of it.
    """
    message = result.failure or f"code {result.code} read by the {result.decoder} decoder"

    def draw() -> Figure:
        figure = Figure(figsize=(7.2, 4.2))
        upper, lower = figure.subplots(2, 1)
        _draw_signal(upper, result)
        if result.folded is not None and result.model is not None:
            _draw_folded(lower, result.folded, result.model)
        else:
            _draw_runs(lower, result)
        upper.set_title(message, fontsize=8, loc="left")
        figure.supxlabel(caption(scene), fontsize=7)
        return figure

    signal = [] if result.signal is None else result.signal.tolist()
    starts = [] if result.chip_starts is None else result.chip_starts.tolist()
    chips = result.chips.tolist()

    def rows() -> Iterable[tuple[object, ...]]:
        yield from zip_longest(range(len(signal)), signal, starts, chips)

    header = ("column of the region", "signal (grey level)", "chip from column", "chip")
    title = f"Decoding, {message}: {caption(scene)}"
    return Drawing(f"decoding-{result.decoder}", title, draw, header, rows)


def _draw_signal(ax: Axes, result: DecodeResult) -> None:
    ax.set_xlabel("column of the region")
    ax.set_ylabel("grey level")
    if result.signal is None:
        return
    ax.plot(result.signal, linewidth=0.8, label="signal", **_SIGNAL)
    if result.threshold is not None:
        ax.axhline(result.threshold, label="threshold", **_THRESHOLD)
    if result.chip_starts is not None and result.chip_length is not None:
        lit = result.chip_starts[result.chips.astype(bool)].tolist()
        bars = [(start, result.chip_length) for start in lit]
        low = float(result.signal.min())
        height = 0.06 * max(float(np.ptp(result.signal)), 1.0)
        ax.broken_barh(bars, (low - 2.0 * height, height), color="0.3", label="chips: lit")
    _legend(ax, 3)


def _legend(ax: Axes, columns: int) -> None:
    """Put the legend above the axes, where it covers nothing."""
    ax.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), fontsize=7, ncols=columns, frameon=False
    )


def _draw_folded(ax: Axes, folded: FloatArray, model: FloatArray) -> None:
    ax.plot(folded, linewidth=1.0, label="signal, folded over one packet", **_SIGNAL)
    ax.plot(model, linewidth=1.0, label="the code's forward model", **_MODEL)
    ax.set_xlabel("eighth of a chip")
    ax.set_ylabel("lit fraction")
    _legend(ax, 2)


def _draw_runs(ax: Axes, result: DecodeResult) -> None:
    ax.set_xlabel("length of a run (columns)")
    ax.set_ylabel("runs")
    if result.histograms is None:
        return
    hatches = ("", "////")
    for value, histogram in enumerate(result.histograms):
        lengths = np.flatnonzero(histogram.counts)
        ax.bar(
            lengths + (0.2 if value else -0.2), histogram.counts[lengths], width=0.4,
            label=("dark runs", "lit runs")[value], hatch=hatches[value], edgecolor="0.2",
            linewidth=0.4, color=("0.6", colours.SIMULATION)[value],
        )  # fmt: skip
        if histogram.split is not None:
            ax.axvline(histogram.split + (0.5 if value else 0.4), **_THRESHOLD)
    _legend(ax, 2)
