"""Draw the bars for print: the map of their least depth, and the flicker for the eye."""

from collections.abc import Iterable

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from occ_model import colours
from occ_model.figures.caption import write_caption
from occ_model.figures.drawing import Drawing
from occ_model.results.bands import DepthMap, EyeFlicker
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND, Unit
from occ_model.study.bands.eye import eye_flicker, risk_limits, risk_lines
from occ_model.study.bands.least_depth import depth_map

_MAX_VALLEY_LINES = 8  # lines drawn at most; further ones are closer together than the cells
_DEPTHS = (0.1, 100.0)  # in percent, at the ends of the colour scale
_MIN_MODULATION = 0.01  # in percent, at the lower end of the chart


def bands_drawing(scene: Scene) -> Drawing:
    depths = depth_map(scene)

    def rows() -> Iterable[tuple[object, ...]]:
        for i, row_depths in enumerate(depths.least.tolist()):
            middle = float(np.sqrt(depths.frequencies[i] * depths.frequencies[i + 1]))
            for j, depth in enumerate(row_depths):
                yield middle, *depths.exposures[j : j + 2].tolist(), 100.0 * depth

    axis = f"{depths.axis.label.lower()} (Hz)"
    header = (axis, "exposure from (s)", "exposure to (s)", "least depth (%)")
    title = "Least depth of the bars over frequency and exposure"
    return Drawing("bands", title, lambda: _draw_map(scene, depths), header, rows)


def flicker_drawing(scene: Scene) -> Drawing:
    """Draw the modulation of the lamp's light over frequency, and the lines of IEEE 1789-2015."""
    eye = eye_flicker(scene)

    def rows() -> Iterable[tuple[object, ...]]:
        parts = (
            ("whole", np.array([eye.frequency]), np.array([eye.percent_flicker])),
            ("sine", eye.frequencies, eye.modulations),
        )
        for part, frequencies, modulations in parts:
            limits = (
                np.where(np.isinf(limit), np.nan, limit) for limit in risk_limits(frequencies)
            )
            for row in np.stack([frequencies, modulations, *limits], axis=1).tolist():
                yield part, *(None if value != value else value for value in row)

    header = ("part", "frequency (Hz)", "modulation (%)", "no effect to (%)", "low risk to (%)")
    return Drawing(
        "flicker", "Flicker of the lamp for the eye", lambda: _draw_chart(scene, eye), header, rows
    )


def _draw_map(scene: Scene, depths: DepthMap) -> Figure:
    figure = Figure(figsize=(5.6, 4.2))
    ax = figure.subplots()
    mesh = ax.pcolormesh(
        depths.frequencies, depths.exposures, 100.0 * np.maximum(depths.least, 1e-30).T,
        norm=LogNorm(*_DEPTHS), cmap="viridis", rasterized=True,
    )  # fmt: skip
    ends = depths.frequencies[[0, -1]]
    for order in range(1, _MAX_VALLEY_LINES + 1 if depths.period else 1):
        label = "exposures of whole periods" if order == 1 else None
        valley = order * depths.period / ends
        ax.plot(ends, valley, color="white", linewidth=0.5, label=label)
    ax.plot(
        [depths.axis.frequency], [scene.camera.exposure_time], "o",
        markerfacecolor="white", markeredgecolor="black", label="the scene", linestyle="",
        clip_on=True,
    )  # fmt: skip
    ax.set(xscale="log", yscale="log", xlim=ends, ylim=depths.exposures[[0, -1]])
    for axis, label, unit in (
        (ax.xaxis, depths.axis.label, HERTZ),
        (ax.yaxis, quantity("exposure_time").label, SECOND),
    ):
        axis.set_label_text(label)
        axis.set_major_formatter(_format_in(unit))
    ax.legend(loc="upper right", fontsize=7, facecolor="0.75")
    figure.colorbar(mesh, ax=ax, label="least depth (%), peak to peak", extend="both")
    write_caption(figure, scene)
    return figure


def _format_in(unit: Unit) -> FuncFormatter:
    return FuncFormatter(lambda value, _: unit.format(value))


def _draw_chart(scene: Scene, eye: EyeFlicker) -> Figure:
    figure = Figure(figsize=(5.6, 4.2))
    ax = figure.subplots()
    lines = risk_lines()
    for line, name, style in (
        (lines.low_risk, "below: low risk", "-"),
        (lines.no_effect, "below: no observable effect", "--"),
    ):  # fmt: skip
        ax.plot(line[:, 0], line[:, 1], style, color=colours.BAND, label=name)
    is_drawn = eye.modulations > _MIN_MODULATION
    ax.plot(
        eye.frequencies[is_drawn], eye.modulations[is_drawn], ".", color=colours.SIMULATION,
        linestyle="", label="its sines",
    )  # fmt: skip
    ax.plot(
        [eye.frequency], [eye.percent_flicker], "o", markerfacecolor="none", color="black",
        linestyle="", label="the lamp as a whole",
    )  # fmt: skip
    ax.set(xscale="log", yscale="log")
    ax.set(xlim=(1.0, max(1e4, 2.0 * eye.frequency)), ylim=(_MIN_MODULATION, 200.0))
    ax.set(xlabel="frequency of the flicker (Hz)", ylabel="modulation (%)")
    ax.legend(loc="lower right", fontsize=7)
    ax.grid(linewidth=0.3)
    source_note = "lines of IEEE 1789-2015 as lighting makers quote them: its text was not checked"
    write_caption(figure, scene, source_note)
    return figure
