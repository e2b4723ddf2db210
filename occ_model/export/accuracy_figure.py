"""What accuracy costs in time, drawn: error over time, both on a logarithmic scale."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.export.drawing import house_style, save_figure
from occ_model.export.provenance import Provenance
from occ_model.export.tables import write_table
from occ_model.results import ACCURACY_PARTS, AccuracyPoint
from occ_model.scene import Scene
from occ_model.simulation_settings import SimulationSettings

_NAME = "accuracy"

_LEAST_ERROR = 1e-16
"""Levels at which no error at all is drawn: a logarithmic scale has no zero."""

_MARKERS = dict(zip(ACCURACY_PARTS, ("o", "s", "^", "D"), strict=True))
_COLOURS = dict(
    zip(
        ACCURACY_PARTS,
        (colours.SIMULATION, colours.BAND, colours.PHOTO, colours.NOISE),
        strict=True,
    )
)
_NAMED_EVERY = 4
"""Of the samples, only every so many are named."""


def write_accuracy_figure(
    folder: Path, scene: Scene, settings: SimulationSettings, points: Sequence[AccuracyPoint]
) -> None:
    """Write the figure as PDF and PNG, and its points as CSV.

    Parameters
    ----------
    folder
        Where to.
    scene, settings
        What was measured.
    points
        As :func:`occ_model.study.accuracy.accuracy` gives them.

    Raises
    ------
    OutputError
        A file cannot be written.
    """
    forced = ", ".join(f"{name} {'on' if on else 'off'}" for name, on in settings.force.items())
    notes = (
        f"tolerance {settings.tolerance:g} levels of the {settings.observable}",
        f"noise {settings.noise}",
        f"by hand: {forced or 'nothing'}",
    )
    title = "Accuracy and time: error over time"
    provenance = Provenance(title, {"at hand": scene}, settings.seed, notes)
    with house_style():
        save_figure(_draw(points), folder, _NAME, provenance)
    header = ("part", "name", "time (ms)", "error (levels)", "current")
    rows = [(p.part, p.name, 1e3 * p.seconds, p.error, int(p.current)) for p in points]
    write_table(folder / f"{_NAME}.csv", header, rows, provenance)


def _draw(points: Sequence[AccuracyPoint]) -> Figure:
    figure = Figure(figsize=(7.2, 6.4))
    axes = figure.subplots(2, 2)
    for ax, (part, title) in zip(axes.flat, ACCURACY_PARTS.items(), strict=True):
        _draw_part(ax, part, [point for point in points if point.part == part])
        ax.set_title(title, fontsize=9)
    figure.supxlabel("time (ms)", fontsize=9)
    figure.supylabel("root mean square error (levels of the stretched profile)", fontsize=9)
    return figure


def _draw_part(ax: Axes, part: str, points: Sequence[AccuracyPoint]) -> None:
    if not points:
        ax.text(0.5, 0.5, "nothing to compare", ha="center", transform=ax.transAxes)
        return
    times = [1e3 * point.seconds for point in points]
    errors = [max(point.error, _LEAST_ERROR) for point in points]
    line = "-" if part in ("integration", "effects") else ""
    ax.plot(times, errors, linestyle=line, linewidth=0.8, color=_COLOURS[part], alpha=0.5)
    ax.plot(times, errors, linestyle="", marker=_MARKERS[part], markersize=4, color=_COLOURS[part])
    for number, point in enumerate(points):
        x, y = times[number], errors[number]
        if point.current:
            ax.plot(x, y, "o", markersize=11, fillstyle="none", color="black", zorder=3)
        if part != "integration" or number % _NAMED_EVERY == 0 or point.current:
            name = f"{point.name} (current)" if point.current else point.name
            ax.annotate(name, (x, y), xytext=(5, 3), textcoords="offset points", fontsize=6)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.margins(0.12)
    ax.grid(linewidth=0.3)
