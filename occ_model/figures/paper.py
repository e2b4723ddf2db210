"""Draw the paper's figures 2 to 6 from the simulation."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Polygon

from occ_model.arrays import FloatArray
from occ_model.camera.projection import row_spans
from occ_model.errors import BandModelUndefined, inflect, one_line
from occ_model.figures.drawing import BAND, PHOTO, PRINT_ENDINGS, SIMULATION, Drawing, write_all
from occ_model.photo.reading.load import Photo
from occ_model.results.frame import Frame
from occ_model.results.sweep import SweepTable
from occ_model.scene.presets import load_preset
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, METRE
from occ_model.simulation.band_model import band_profile
from occ_model.simulation.render import render
from occ_model.study.paper_grid import DISTANCES, FREQUENCIES
from occ_model.transmitter.scheme import packet

_PICTURE_STEP = 8  # side in pixels of a picture's averaged cells; print resolves nothing smaller

_PACKETS_SHOWN = 2.5


def write_process_figure(folder: Path) -> None:
    """Write figure 2: corners, mask, calculated values and simulated picture."""
    scene = load_preset("phone-68us")
    frame = render(scene, tolerance=math.inf)
    figure = Figure(figsize=(7.2, 2.5))
    axes = figure.subplots(1, 4)
    rows, columns = frame.image.shape
    mask = np.zeros((rows, columns), dtype=np.uint8)
    for row, (first, last) in enumerate(zip(*row_spans(frame.corners, rows, columns), strict=True)):
        mask[row, first:last] = 255
    values = np.broadcast_to(frame.signal, (rows, columns))
    for ax, picture in zip(axes, (None, mask, values, frame.image), strict=True):
        _show_picture(ax, picture, rows, columns)
    axes[0].add_patch(Polygon(frame.corners, closed=True, fill=False, color=SIMULATION["color"]))
    axes[0].plot(*frame.corners.T, "o", color=BAND["color"], markersize=4)
    titles = ("(a) corners", "(b) mask", "(c) calculated values", "(d) simulated picture")
    for ax, title in zip(axes, titles, strict=True):
        ax.set_title(title, fontsize=9)
    axes[0].set_ylabel("row")
    places = "; ".join(f"column {x:.2f}, row {y:.2f}" for x, y in frame.corners.tolist())
    title = "Figure 2: from the panel's corners to the picture"
    provenance = Provenance(title, {"phone-68us": scene}, notes=(f"corners: {places}",))
    is_lit = mask > 0
    header = (
        "column", "calculated value (grey level)", "first row of the mask", "rows of the mask",
    )  # fmt: skip
    calculated = frame.signal.astype(np.int64)  # whole numbers, as there are no image effects
    table = np.stack(
        [np.arange(columns), calculated, is_lit.argmax(axis=0), is_lit.sum(axis=0)], axis=1
    )
    _write(folder, "figure-2", figure, header, table.tolist(), provenance)


def _write(
    folder: Path,
    name: str,
    figure: Figure,
    header: Sequence[str],
    rows: Sequence[Sequence[object]],
    provenance: Provenance,
) -> None:
    drawing = Drawing(name, provenance.title, lambda: figure, header, lambda: rows)
    write_all(folder, [drawing], lambda _: provenance, PRINT_ENDINGS)


def _show_picture(ax: Axes, picture: np.ndarray | None, rows: int, columns: int) -> None:
    ax.set(xlim=(0, columns), ylim=(rows, 0), aspect="equal", xlabel="column")
    ax.tick_params(labelsize=7)
    ax.set(xticks=[0, columns], yticks=[0, rows])
    if picture is not None:
        step = _PICTURE_STEP
        cropped = picture[: rows // step * step, : columns // step * step]
        # Average each cell, since taking one pixel of it would show false stripes.
        cells = cropped.reshape(rows // step, step, columns // step, step).mean(axis=(1, 3))
        ax.imshow(cells, cmap="gray", vmin=0, vmax=255, extent=(0, columns, rows, 0))


def write_profile_figure(folder: Path, number: int, preset: str, photo: Photo | None) -> None:
    """Write figure 3 or 4: the profiles of the band model, the simulation and a photo."""
    scene = load_preset(preset)
    frame = render(scene, tolerance=math.inf)
    band, undefined_reason = None, ""
    try:
        # Count bands as the paper does; aligned ones would coincide with the simulation.
        band = band_profile(scene.replace(band_reading="literal"))
    except BandModelUndefined as reason:
        undefined_reason = str(reason)
    first, last = choose_columns(scene, frame)
    column = np.arange(first, last)
    profiles: dict[str, FloatArray | None] = {
        "band model": None if band is None else band[first:last],
        "simulation": frame.profile[first:last],
        "simulation, enhanced": frame.signal[first:last],
        "photo": None if photo is None else pad_profile(photo.profile, last - first),
    }
    figure = Figure(figsize=(7.2, 2.8))
    ax = figure.subplots()
    styles = (BAND, {**SIMULATION, "alpha": 0.45}, SIMULATION, PHOTO)
    for (name, values), style in zip(profiles.items(), styles, strict=True):
        if values is not None:
            ax.plot(column, values, label=name, linewidth=1.2, **style)  # type: ignore[arg-type]
    ax.set(xlabel="column", ylabel="grey level", ylim=(0, 262))
    figure.legend(loc="outside upper center", ncols=4, frameon=False)
    if undefined_reason:
        ax.set_title(undefined_reason, fontsize=8)
    frequency = HERTZ.format(scene.transmitter.switching_frequency)
    distance = METRE.format(scene.pose.distance)
    title = f"Figure {number}: pixel values, {preset} at {frequency} and {distance}"
    notes = (f"photo {one_line(photo.path.name)}, drawn from column {first}",) if photo else ()
    provenance = Provenance(title, {preset: scene}, notes=notes)
    drawn = {name: values for name, values in profiles.items() if values is not None}
    table = np.stack([column, *drawn.values()], axis=1)
    header = ("column", *(f"{name} (grey level)" for name in drawn))
    _write(folder, f"figure-{number}", figure, header, table.tolist(), provenance)


def choose_columns(scene: Scene, frame: Frame) -> tuple[int, int]:
    first = max(0, int(np.ceil(frame.corners[:, 0].min())))
    period = len(packet(scene)) * scene.transmitter.switching_period / scene.camera.readout_time
    return first, min(len(frame.profile), first + round(_PACKETS_SHOWN * period))


def pad_profile(values: FloatArray, length: int) -> FloatArray:
    return np.pad(values[:length], (0, max(0, length - len(values))), constant_values=np.nan)


def write_rate_figure(
    folder: Path, number: int, device: str, tables: Mapping[str, SweepTable]
) -> None:
    """Write figure 5 or 6: success rate against frequency and distance, for both exposures."""
    settings = next(iter(tables.values())).request.settings
    title = f"Figure {number}: success rate, {device}, {inflect(settings.images, 'image')} a point"
    scenes = {preset: table.request.scene for preset, table in tables.items()}
    provenance = Provenance(title, scenes, settings.seed)
    header = (
        "preset", "decoder", "switching frequency (Hz)", "distance (m)", "images", "seed",
        "success rate (%)", "95 % from (%)", "95 % to (%)",
    )  # fmt: skip
    rows = [
        (
            preset, row.decoder, row.point["switching_frequency"], row.point["distance"],
            settings.images, settings.seed, row.rate, row.low, row.high,
        )
        for preset, table in tables.items()
        for row in table.each_row()
    ]  # fmt: skip
    _write(folder, f"figure-{number}", rate_maps(tables), header, rows, provenance)


def rate_maps(tables: Mapping[str, SweepTable]) -> Figure:
    decoders = next(iter(tables.values())).decoders
    figure = Figure(figsize=(7.2, 2.6 * len(decoders) + 0.6))
    axes = figure.subplots(len(decoders), len(tables), squeeze=False, sharex=True, sharey=True)
    for column, table in enumerate(tables.values()):
        exposure = table.request.scene.camera.exposure_time
        for row, decoder in enumerate(decoders):
            ax = axes[row, column]
            image = _draw_rates(ax, table.rates(decoder).T)
            ax.set_title(f"{exposure * 1e6:.0f} µs, {decoder} decoder", fontsize=9)
            ax.label_outer()
    figure.supxlabel("switching frequency (kHz)", fontsize=9)
    figure.supylabel("distance (cm)", fontsize=9)
    figure.colorbar(image, ax=axes, label="success rate (%)", shrink=0.8)
    return figure


def _draw_rates(ax: Axes, grid: FloatArray) -> AxesImage:
    image = ax.imshow(grid, cmap="cividis", vmin=0, vmax=100, origin="lower", aspect="auto")
    ax.set_xticks(range(len(FREQUENCIES)), [f"{f / 1e3:.0f}" for f in FREQUENCIES], fontsize=7)
    ax.set_yticks(range(len(DISTANCES)), [f"{d * 100:.0f}" for d in DISTANCES], fontsize=7)
    ax.spines[:].set_visible(False)
    for (y, x), rate in np.ndenumerate(grid):
        colour = "black" if rate > 50 else "white"
        ax.text(x, y, f"{rate:.0f}", ha="center", va="center", fontsize=6, color=colour)
    return image
