"""Draw the accuracy study: error against time, both on a logarithmic scale."""

from collections.abc import Iterable, Sequence
from math import isclose
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Annotation
from matplotlib.ticker import LogFormatterMathtext
from matplotlib.transforms import Bbox

from occ_model import colours
from occ_model.figures.drawing import PRINT_ENDINGS, Drawing, settings_notes, write_all
from occ_model.results.accuracy import ACCURACY_PARTS, CHAINED_PARTS, LEAST_ERROR, AccuracyPoint
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.scene.units import LEVEL

_STYLES: dict[str, dict[str, Any]] = {
    part: {"color": colour, "marker": marker, "markersize": 4}
    for part, colour, marker in zip(
        ACCURACY_PARTS,
        (colours.SIMULATION, colours.BAND, colours.PHOTO, colours.REGION),
        ("o", "s", "^", "v"),
        strict=True,
    )
}

_NAME_PLACES = [(side, height) for height in (4, -9, 11, -16) for side in (6, -6)]
"""Offsets in points of a name from its data point, in the order in which they are tried."""


def write_accuracy_figure(
    folder: Path, scene: Scene, settings: SimulationSettings, points: Sequence[AccuracyPoint]
) -> None:
    drawing = accuracy_drawing(points)
    notes = settings_notes(settings)
    provenance = Provenance(drawing.title, {"of this file": scene}, settings.seed, notes)
    write_all(folder, [drawing], lambda _: provenance, PRINT_ENDINGS)


def accuracy_drawing(points: Sequence[AccuracyPoint]) -> Drawing:
    unit = points[0].unit
    header = ("part", "name", "time (ms)", f"error ({unit})", "current")

    def rows() -> Iterable[tuple[object, ...]]:
        for p in points:
            yield (p.part, p.name, 1e3 * p.seconds, p.error, int(p.current))

    title = "Accuracy and time: error over time"
    return Drawing("accuracy", title, lambda: _draw(points), header, rows)


def _draw(points: Sequence[AccuracyPoint]) -> Figure:
    figure = Figure(figsize=(7.2, 4.6))
    ax = figure.subplots()
    names: list[Annotation] = []
    for part in ACCURACY_PARTS:
        names += _draw_part(ax, part, [point for point in points if point.part == part])
    ax.plot([], [], "o", markersize=8, fillstyle="none", color="black", label="current setting")
    ax.set(xscale="log", yscale="log")
    ax.margins(0.08)
    ax.set_ylim(bottom=LEAST_ERROR / 1.6)
    ax.axhline(LEAST_ERROR, color="grey", linewidth=0.5, linestyle="--")
    power = LogFormatterMathtext()
    ax.yaxis.set_major_formatter(
        lambda error, _: (r"$\leq$ " if isclose(error, LEAST_ERROR) else "") + power(error)
    )
    ax.grid(linewidth=0.3)
    ax.set_xlabel("time (ms)")
    unit = points[0].unit
    quantity = "levels of the stretched profile" if unit == LEVEL.symbol else f"decision {unit}"
    ax.set_ylabel(f"root mean square error\n({quantity})")
    figure.legend(loc="outside right center", frameon=False, fontsize=7)
    _place_names(figure, ax, names)
    return figure


def _place_names(figure: Figure, ax: Axes, names: Sequence[Annotation]) -> None:
    """Place each name so that it covers no other and ends inside the axes, if possible."""
    figure.draw_without_rendering()  # this gives the axes their size
    boxes: list[Bbox] = []
    for name in names:
        for place in _NAME_PLACES:
            name.xyann = place
            name.set_horizontalalignment("left" if place[0] > 0 else "right")
            box = name.get_window_extent()
            if box.x1 < ax.bbox.x1 and not box.count_overlaps(boxes):
                break
        boxes.append(box)


def _draw_part(ax: Axes, part: str, points: Sequence[AccuracyPoint]) -> list[Annotation]:
    times = [1e3 * point.seconds for point in points]
    errors = [max(point.error, LEAST_ERROR) for point in points]
    line = "-" if part in CHAINED_PARTS else ""
    ax.plot(times[:-1], errors[:-1], linestyle=line, linewidth=0.7, **_STYLES[part])
    ax.plot(times[-1:], errors[-1:], linestyle="", label=ACCURACY_PARTS[part], **_STYLES[part])
    names: list[Annotation] = []
    for number, (point, x, y) in enumerate(zip(points, times, errors, strict=True)):
        is_last = number == len(points) - 1  # the closed form is the last of the integrations
        if part != "integration" or number % 4 == 0 or is_last or point.current:
            name = point.name if part != "effects" else str(number)
            place = _NAME_PLACES[0]
            names.append(ax.annotate(name, (x, y), place, textcoords="offset points", fontsize=6))
        if part == "effects":
            ax.plot([], [], " ", label=f"   {number}  {point.name}")
        if point.current:
            ax.plot(x, y, "o", markersize=10, fillstyle="none", color="black", zorder=3)
    return names
