"""Draw the accuracy study: error over time, both on a logarithmic scale."""

from collections.abc import Iterable, Sequence
from math import isclose
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterMathtext

from occ_model import colours
from occ_model.figures.drawing import Drawing, settings_notes
from occ_model.results.accuracy import ACCURACY_PARTS, CHAINED_PARTS, LEAST_ERROR, AccuracyPoint
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.scene.units import LEVEL

_MARKERS = dict(zip(ACCURACY_PARTS, ("o", "s", "^", "v", "D"), strict=True))
_COLOURS = dict(
    zip(
        ACCURACY_PARTS,
        (colours.SIMULATION, colours.BAND, colours.PHOTO, colours.REGION, colours.NOISE),
        strict=True,
    )
)


def write_accuracy_figure(
    folder: Path, scene: Scene, settings: SimulationSettings, points: Sequence[AccuracyPoint]
) -> None:
    drawing = accuracy_drawing(points)
    notes = settings_notes(settings)
    provenance = Provenance(drawing.title, {"at hand": scene}, settings.seed, notes)
    for ending in (".pdf", ".png", ".csv"):
        drawing.write(folder / f"{drawing.name}{ending}", provenance)


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
    for part in ACCURACY_PARTS:
        _draw_part(ax, part, [point for point in points if point.part == part])
    ax.plot([], [], "o", markersize=8, fillstyle="none", color="black", label="current setting")
    ax.set_xscale("log")
    ax.set_yscale("log")
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
    of_what = "levels of the stretched profile" if unit == LEVEL.symbol else f"decision {unit}"
    ax.set_ylabel(f"root mean square error\n({of_what})")
    figure.legend(loc="outside right center", frameon=False, fontsize=7)
    return figure


def _draw_part(ax: Axes, part: str, points: Sequence[AccuracyPoint]) -> None:
    style: dict[str, Any] = {"color": _COLOURS[part], "marker": _MARKERS[part], "markersize": 4}
    times = [1e3 * point.seconds for point in points]
    errors = [max(point.error, LEAST_ERROR) for point in points]
    line = "-" if part in CHAINED_PARTS else ""
    ax.plot(times[:-1], errors[:-1], linestyle=line, linewidth=0.7, **style)
    ax.plot(times[-1:], errors[-1:], linestyle="", label=ACCURACY_PARTS[part], **style)
    for number, (point, x, y) in enumerate(zip(points, times, errors, strict=True)):
        # Left and right in turn, so that neighbours' names do not cover each other.
        side = -1 if number % 2 else 1
        align = "left" if side > 0 else "right"
        name = point.name if part != "effects" else str(number)
        is_last = number == len(points) - 1  # the closed form, of the integrations
        if part != "integration" or number % 4 == 0 or is_last or point.current:
            ax.annotate(
                name, (x, y), (6 * side, 4), textcoords="offset points", fontsize=6, ha=align
            )
        if part == "effects":
            ax.plot([], [], " ", label=f"   {number}  {point.name}")
        if point.current:
            ax.plot(x, y, "o", markersize=10, fillstyle="none", color="black", zorder=3)
