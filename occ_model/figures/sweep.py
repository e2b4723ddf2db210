"""Draw a sweep's success rates as curves against one parameter, or as maps of two."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

from occ_model import colours
from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError, inflect
from occ_model.figures.drawing import Drawing
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_csv import column_title, format_value
from occ_model.results.sweep_request import ShownQuantity, SweepPoint
from occ_model.scene.parameter_kinds import Choice, ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.provenance import Provenance
from occ_model.study.confidence import wilson_interval

_STYLES: tuple[dict[str, Any], ...] = (
    {"color": colours.SIMULATION, "marker": "o", "markersize": 6.5, "linestyle": "-"},
    {"color": colours.BAND, "marker": "s", "markersize": 3, "linestyle": "--"},
    {"color": colours.PHOTO, "marker": "^", "markersize": 3, "linestyle": ":"},
    {"color": colours.NOISE, "marker": "D", "markersize": 3, "linestyle": "-."},
)
"""Distinct for colour-blind readers, in grey, and where curves coincide."""

_TITLES = {"rate": "Success rate", "bits": "Bits a second"}
_LABELS = {"rate": "success rate (%)", "bits": "bits a second"}

_REFUSED_COLOUR = "0.75"  # grey is not among the map's colours
_TICKS = 10  # largest number of labels at an axis
_FAILED = "a plug-in failed: see the notes in the table"

_CELLS_WITH_NUMBERS = 14  # number of cells on a side up to which each cell shows its number


def write_sweep_figure(path: Path, table: SweepTable, quantity: ShownQuantity = "rate") -> None:
    """Draw a table's success rates, or bits a second, in the format of the file's ending.

    With one axis, there is a curve with 95 % intervals for each decoder. With two axes, there is a
    map for each decoder, with the first axis from left to right; points that the model refuses are
    grey.
    """
    names = list(table.axes)
    if len(names) > 2:
        raise ParameterError(
            f"The sweep varies {', '.join(names)}; allowed in a figure: one or two parameters."
        )
    sweep_drawing(table, quantity).write(path, _provenance(table, quantity))


def sweep_drawing(table: SweepTable, quantity: ShownQuantity = "rate") -> Drawing:
    """Draw a table's success rates, or bits a second, against one axis or two."""
    names = list(table.axes)

    def rows() -> Iterable[tuple[object, ...]]:
        for row in table.rows:
            values = (row.point[name] for name in names)
            yield (
                *values, row.decoder, row.right, row.sent, row.rate, row.low, row.high,
                row.bits_a_second, row.note,
            )  # fmt: skip

    header = (
        *map(column_title, names), "decoder", "right bits", "sent bits",
        "success rate (%)", "95 % from (%)", "95 % to (%)", "bits a second", "note",
    )  # fmt: skip
    title = (
        f"{_TITLES[quantity]} over {' and '.join(names)}, "
        f"{inflect(table.request.settings.images, 'image')}"
    )
    draw = _draw_curves if len(names) == 1 else _draw_maps
    return Drawing("map", title, lambda: draw(table, quantity), header, rows)


def _provenance(table: SweepTable, quantity: ShownQuantity) -> Provenance:
    settings = table.request.settings
    title = f"{_TITLES[quantity]} over {' and '.join(table.axes)}"
    notes = (
        f"{inflect(settings.images, 'image')} a point",
        f"{inflect(settings.frames_a_second, 'image')} a second, or as many as can be read out",
        *(f"{name}: {', '.join(map(format_value, values))}" for name, values in table.axes.items()),
    )
    return Provenance(title, {"of this file": table.request.scene}, settings.seed, notes)


def _values(table: SweepTable, decoder: str, quantity: ShownQuantity) -> FloatArray:
    return table.rates(decoder) if quantity == "rate" else table.bits_a_second(decoder)


def _intervals(
    table: SweepTable, decoder: str, quantity: ShownQuantity
) -> tuple[FloatArray, FloatArray]:
    if quantity == "rate":
        return table.intervals(decoder)
    bits, images = table.bits_a_second(decoder), table.request.settings.images
    complete_images = table.whole[..., table.decoders.index(decoder)]
    # The rate if all images were read, which no interval can exceed.
    most_bits = np.array([_most_bits(table, point) for point in table.each_point()])
    ends = np.array([wilson_interval(int(count), images) for count in complete_images.ravel()])
    ends = ends.reshape(*bits.shape, 2) * most_bits.reshape(bits.shape)[..., None]
    return ends[..., 0], ends[..., 1]


def _most_bits(table: SweepTable, point: SweepPoint) -> float:
    """Return the bits a second of a point if every image were read completely."""
    complete_images = (table.request.settings.images,) * len(table.decoders)
    bits = table.request.bits_a_second(replace(point, whole=complete_images), 0)
    return np.nan if bits is None else bits


def _highest_value(table: SweepTable, quantity: ShownQuantity) -> float:
    """Return the upper end of the axis or of the colour scale."""
    if quantity == "rate":
        return 100.0
    bits = [_most_bits(table, point) for point in table.each_point()]
    return float(np.nanmax(bits)) if np.isfinite(bits).any() else 1.0


def _draw_curves(table: SweepTable, quantity: ShownQuantity) -> Figure:
    ((name, values),) = table.axes.items()
    figure = Figure(figsize=(6.4, 3.6))
    ax = figure.subplots()
    unit, factor = _choose_unit(name, values)
    positions, labels = _axis_positions(name, values, factor)
    for decoder, base_style in zip(table.decoders, _STYLES * len(table.decoders), strict=False):
        style = base_style if labels is None else {**base_style, "linestyle": ""}
        rates = _values(table, decoder, quantity)
        low, high = _intervals(table, decoder, quantity)
        error = np.maximum([rates - low, high - rates], 0.0)  # rounding can make it negative
        ax.errorbar(
            positions, rates, error, label=f"{decoder} decoder", capsize=2, linewidth=1.0,
            elinewidth=0.7, markerfacecolor="none", clip_on=False, **style,
        )  # fmt: skip
    if labels is not None:
        ax.set_xticks(
            positions[:: _label_step(len(positions))], labels[:: _label_step(len(positions))]
        )
    elif _is_log(name, positions):
        ax.set_xscale("log")
        ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
        ax.xaxis.set_minor_formatter(NullFormatter())
    highest = _highest_value(table, quantity)
    ax.set(ylim=(-0.03 * highest, 1.03 * highest), yticks=np.linspace(0.0, highest, 6))
    ax.grid(linewidth=0.3)
    ax.set(xlabel=_axis_label(name, unit), ylabel=_LABELS[quantity])
    title = _FAILED if table.faults else None
    figure.legend(loc="outside upper center", ncols=len(table.decoders), frameon=False, title=title)
    return figure


def _draw_maps(table: SweepTable, quantity: ShownQuantity) -> Figure:
    (across, columns), (upwards, rows) = table.axes.items()
    width = min(3.2 * len(table.decoders) + 1.6, 12.0)
    figure = Figure(figsize=(width, 3.6))
    axes = figure.subplots(1, len(table.decoders), squeeze=False, sharex=True, sharey=True)[0]
    for ax, decoder in zip(axes, table.decoders, strict=True):
        # All cells have the same size, as the values need be neither evenly spaced nor numbers.
        _draw_map(ax, _values(table, decoder, quantity).T, _highest_value(table, quantity))
        _label_cells(ax.xaxis, across, columns)
        _label_cells(ax.yaxis, upwards, rows)
        ax.set_title(f"{decoder} decoder", fontsize=9)
        ax.label_outer(remove_inner_ticks=True)
    figure.supxlabel(_axis_label(across, _choose_unit(across, columns)[0]), fontsize=9)
    figure.supylabel(_axis_label(upwards, _choose_unit(upwards, rows)[0]), fontsize=9)
    colour = ScalarMappable(Normalize(0, _highest_value(table, quantity)), "cividis")
    figure.colorbar(colour, ax=list(axes), label=_LABELS[quantity])
    remarks = []
    if (table.sent == 0).any():
        remarks.append(Patch(color=_REFUSED_COLOUR, label="no picture: see the notes in the table"))
    if table.faults:
        remarks.append(Patch(color="none", label=_FAILED))
    if remarks:
        figure.legend(handles=remarks, loc="outside upper left", frameon=False, fontsize=7)
    return figure


def _draw_map(ax: Axes, grid: FloatArray, highest: float) -> None:
    ax.set_facecolor(_REFUSED_COLOUR)
    ax.imshow(
        grid, cmap="cividis", vmin=0, vmax=highest, origin="lower", aspect="auto",
        interpolation="nearest",
    )  # fmt: skip
    ax.spines[:].set_visible(False)
    if max(grid.shape) > _CELLS_WITH_NUMBERS:
        return
    for (y, x), rate in np.ndenumerate(grid):
        if not np.isnan(rate):
            colour = "black" if rate > 0.5 * highest else "white"
            ax.text(x, y, f"{rate:.0f}", ha="center", va="center", fontsize=6, color=colour)


def _label_cells(axis: Any, name: str, values: tuple[ParameterValue, ...]) -> None:
    _, factor = _choose_unit(name, values)
    axis.set_tick_params(labelsize=7)
    positions, word_labels = _axis_positions(name, values, factor)
    if word_labels is None and len(positions) > _TICKS and bool(np.all(np.diff(positions) > 0)):
        axis.set_ticks(*_choose_round_ticks(positions, _is_log(name, positions)))
        return
    step = _label_step(len(values))
    labels = [_format_number(value, factor) for value in values]
    axis.set_ticks(range(0, len(values), step), labels[::step])


def _choose_round_ticks(positions: FloatArray, is_log: bool) -> tuple[FloatArray, list[str]]:
    """Choose round values among the cells' increasing ones; return their positions and labels."""
    locator = LogLocator(subs=(1, 2, 5)) if is_log else MaxNLocator(_TICKS - 1, steps=[1, 2, 5, 10])
    marks = [
        mark
        for mark in locator.tick_values(positions[0], positions[-1])
        if positions[0] <= mark <= positions[-1]
    ]
    scale = np.log if is_log else np.asarray
    return np.interp(scale(marks), scale(positions), np.arange(len(positions))), [
        f"{mark:g}" for mark in marks
    ]


def _label_step(count: int) -> int:
    return -(-count // _TICKS)


def _axis_positions(
    name: str, values: tuple[ParameterValue, ...], factor: float
) -> tuple[FloatArray, list[str] | None]:
    """Return the positions of values on an axis, and their labels if they are words."""
    if isinstance(PARAMETERS[name], Choice):
        return np.arange(len(values), dtype=np.float64), [str(value) for value in values]
    return np.array([float(value) / factor for value in values]), None


def _is_log(name: str, values: FloatArray) -> bool:
    """Return whether values are spaced by ratios rather than by steps."""
    parameter = PARAMETERS[name]
    is_log = isinstance(parameter, Quantity) and parameter.scale == "log"
    if not is_log or len(values) < 3 or float(values.min()) <= 0.0:
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return bool(np.std(ratios) / abs(np.mean(ratios)) < np.std(steps) / abs(np.mean(steps)))


def _choose_unit(name: str, values: tuple[ParameterValue, ...]) -> tuple[str, float]:
    """Choose the unit that suits the median of some values; return it and its SI value."""
    parameter = PARAMETERS[name]
    if not isinstance(parameter, Quantity):
        return "", 1.0
    sizes = sorted(abs(float(value)) for value in values)
    return parameter.unit.display(sizes[len(sizes) // 2])


def _axis_label(name: str, unit: str) -> str:
    label = PARAMETERS[name].in_sentence
    return f"{label} ({unit})" if unit else label


def _format_number(value: ParameterValue, factor: float) -> str:
    return value if isinstance(value, str) else f"{float(value) / factor:.3g}"
