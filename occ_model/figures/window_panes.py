"""Draw the window's picture, a photo over it, and its column profile for print."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from occ_model import colours
from occ_model.arrays import ByteArray, FloatArray
from occ_model.figures.caption import caption, write_caption
from occ_model.figures.drawing import BAND, PHOTO, SIMULATION, THRESHOLD, Drawing
from occ_model.results.comparison import Comparison
from occ_model.results.decoding import DecodeResult, Region
from occ_model.results.frame import PICTURES, Frame
from occ_model.teaching.packet_fields import threshold_levels


@dataclass(frozen=True, slots=True)
class PhotoLayer:
    """Where a photo is placed over a simulated picture, and how much of it is visible."""

    # The pixel of the simulated picture under the centre of the photo's first pixel
    column: float = 0.0
    row: float = 0.0
    scale: float = 1.0  # Pixels of the simulated picture per pixel of the photo
    opacity: float = 1.0  # Opacity of the photo, from 0 to 1
    # The row of the simulated picture below which the photo is visible; None for all of it
    from_row: float | None = None

    def first_row(self, rows: int) -> int:
        """Return the first visible row of a photo of ``rows`` rows; ``rows`` if none is visible."""
        if self.from_row is None:
            return 0
        top = self.row - self.scale / 2
        return min(max(round((self.from_row - top) / self.scale), 0), rows)

    def extent(self, rows: int, columns: int, first: int = 0) -> tuple[float, float, float, float]:
        """Return the left, right, lower and upper edge of a photo, from its row ``first`` on."""
        left, top = self.column - self.scale / 2, self.row - self.scale / 2
        right, bottom = left + columns * self.scale, top + rows * self.scale
        return left, right, bottom, top + first * self.scale

    @property
    def words(self) -> str:
        if self.from_row is None:
            return f"photo over it, opacity {100 * self.opacity:.0f} %"
        return f"photo from row {self.from_row:.0f} on"


@dataclass(frozen=True, eq=False, slots=True)
class Difference:
    """The difference between a photo and a simulated picture where they overlap."""

    # Shape (cell rows, cell columns): the absolute difference in grey levels, averaged over cells
    levels: FloatArray
    # The left, right, lower and upper edge of the cells in pixels of the simulated picture
    extent: tuple[float, float, float, float]
    gain: int  # Factor on the levels in the drawing, where products above 255 are white

    @property
    def words(self) -> str:
        return f"its difference from the photo × {self.gain}, black where equal"  # noqa: RUF001

    def centres(self) -> tuple[FloatArray, FloatArray]:
        """Return the rows and the columns of the cells' centres."""
        left, right, bottom, top = self.extent
        rows, columns = self.levels.shape
        return (
            top + (bottom - top) * (np.arange(float(rows)) + 0.5) / rows,
            left + (right - left) * (np.arange(float(columns)) + 0.5) / columns,
        )

    def draw(self, ax: Axes) -> None:
        scaled = np.minimum(self.gain * self.levels, 255.0)
        ax.imshow(scaled, cmap="gray", vmin=0, vmax=255, extent=self.extent)


def lay_over(ax: Axes, cells: FloatArray, layer: PhotoLayer, shape: tuple[int, ...]) -> None:
    """Draw the cells of a part of a photo over the drawn picture, inside its limits."""
    limits = {"xlim": ax.get_xlim(), "ylim": ax.get_ylim()}
    rows, columns = shape
    extent = layer.extent(rows, columns, layer.first_row(rows))
    ax.imshow(cells, cmap="gray", vmin=0, vmax=255, alpha=layer.opacity, extent=extent)
    if layer.from_row is not None:
        ax.axhline(layer.from_row, color=colours.REGION, linewidth=1.0)
    ax.set(**limits)


MOST_CELLS = 900  # most cells on each side of a printed picture; print resolves no more

_RESIDUAL = "photo minus simulation, weighted by the height of the photo's stripes"
_PHOTO = "photo, fitted levels"  # with the mean and the contrast of the simulation's profile
_MIN_HEIGHT = 1.3  # inches, of the figure of a flat picture with the texts above and below it

_AXIS_OF_RESIDUAL = 2.0  # range of the residual's axis, as a multiple of the usual residual


def picture_drawing(
    frame: Frame,
    region: Region | None = None,
    photo: ByteArray | None = None,
    picture_kind: str = PICTURES[0],
    layer: PhotoLayer | Difference | None = None,
    about: str = "",
) -> Drawing:
    """Draw a simulated picture with the decoder's region, and a photo beside it or in a ``layer``.

    The table has the means of cells of pixels as small as print can resolve.
    """
    image, name = frame.picture(picture_kind), frame.picture_title(picture_kind)
    cells, size = _average_cells(image)
    layer_text = "" if photo is None or layer is None else f"; {layer.words}"
    title_of_picture = f"{name}{layer_text}"
    difference = layer if isinstance(layer, Difference) else None

    def draw() -> Figure:
        pictures = [image] if photo is None or layer is not None else [image, photo]
        rows, columns = image.shape if difference is None else difference.levels.shape
        height = max(0.9 + 3.1 * min(rows / columns, 1.6), _MIN_HEIGHT)
        figure = Figure(figsize=(3.6 * len(pictures), height))
        axes = figure.subplots(1, len(pictures), squeeze=False)[0]
        for ax, picture in zip(axes, pictures, strict=True):
            if difference is None:
                show_picture(ax, picture)
            else:
                difference.draw(ax)
                _label_axes(ax)
            ax.set_title("Photo" if picture is photo else title_of_picture, fontsize=9)
        if photo is not None and isinstance(layer, PhotoLayer):
            visible = photo[layer.first_row(len(photo)) :]
            if len(visible):
                lay_over(axes[0], _average_cells(visible)[0], layer, photo.shape)
        if region is not None:
            corner = (region.first_column - 0.5, region.first_row - 0.5)
            style: dict[str, Any] = {"fill": False, "linewidth": 1.0, "color": colours.REGION}
            axes[0].add_patch(Rectangle(corner, region.columns, region.rows, **style))
        write_caption(figure, frame.scene, about)
        return figure

    if difference is not None:
        title = f"{name}; its difference from the photo in levels: {caption(frame.scene, about)}"
        return _cells_drawing(title, draw, difference.levels, *difference.centres())
    down, across = (size * (np.arange(float(count)) + 0.5) - 0.5 for count in cells.shape)
    return _cells_drawing(f"{name}: {caption(frame.scene, about)}", draw, cells, down, across)


def _cells_drawing(
    title: str,
    draw: Callable[[], Figure],
    cells: FloatArray,
    down: FloatArray,
    across: FloatArray,
) -> Drawing:
    """Make the drawing of a picture, whose table has the cells by their centres."""

    def rows() -> Iterable[tuple[object, ...]]:
        for row, values in zip(down.tolist(), cells.tolist(), strict=True):
            yield (row, *values)

    columns = [f"column {column:g}" for column in across.tolist()]
    return Drawing("picture", title, draw, ("row", *columns), rows)


def _average_cells(image: ByteArray) -> tuple[FloatArray, int]:
    """Average a picture over square cells as small as print resolves; return their side, too."""
    size = -(-max(image.shape) // MOST_CELLS)
    rows, columns = image.shape[0] // size, image.shape[1] // size
    cropped = image[: rows * size, : columns * size]
    # Average each cell, since taking one pixel of it would show false stripes.
    cells = cv2.resize(cropped, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.asarray(cells, dtype=np.float64), size


def show_picture(ax: Axes, picture: ByteArray) -> None:
    """Draw a picture in cells as small as print resolves, its first pixel's centre at (0, 0)."""
    rows, columns = picture.shape
    extent = (-0.5, columns - 0.5, rows - 0.5, -0.5)
    ax.imshow(_average_cells(picture)[0], cmap="gray", vmin=0, vmax=255, extent=extent)
    _label_axes(ax)


def _label_axes(ax: Axes) -> None:
    ax.set(xlabel="column", ylabel="row")
    ax.tick_params(labelsize=7)


def profile_drawing(  # noqa: PLR0913 - all but two have defaults
    frame: Frame,
    band: FloatArray | None,
    undefined: str = "",
    comparison: Comparison | None = None,
    columns: slice = slice(None),
    *,
    enhanced: bool = False,
    decoded: DecodeResult | None = None,
    about: str = "",
) -> Drawing:
    """Draw the column profiles, and the photo's residual below them; the table has all columns.

    ``undefined`` is the reason why there is no ``band``. With ``enhanced`` the profiles are those
    after the receiver's enhancement, to which ``band`` and ``comparison`` must already belong.
    """
    simulated = frame.signal if enhanced else frame.profile
    profiles = {"simulation": simulated}
    if band is not None:
        profiles["band model"] = band
    if comparison is not None:
        values = {_PHOTO: comparison.photo, _RESIDUAL: comparison.residual}
        for name, part in values.items():
            profiles[name] = np.full(len(frame.profile), np.nan)  # outside the photo
            profiles[name][comparison.first_column :][: len(part)] = part
    threshold = None if decoded is None else _place_threshold(simulated, decoded, enhanced)

    def draw() -> Figure:
        figure = _profile_figure(profiles, undefined, comparison, columns, enhanced, threshold)
        write_caption(figure, frame.scene, about)
        return figure

    def rows() -> Iterable[tuple[object, ...]]:
        values = [profile.tolist() for profile in profiles.values()]
        yield from zip(range(len(frame.profile)), *values, strict=True)

    header = ("column", *(f"{name} (grey level)" for name in profiles))
    pane = "Column profile after the receiver's enhancement" if enhanced else "Column profile"
    return Drawing("profile", f"{pane}: {caption(frame.scene, about)}", draw, header, rows)


def _place_threshold(simulated: FloatArray, decoded: DecodeResult, enhanced: bool) -> float | None:
    levels = threshold_levels(simulated, decoded)
    if levels is None or decoded.threshold is None:
        return None
    return decoded.threshold if enhanced else sum(levels) / 2.0


def _profile_figure(
    lines: Mapping[str, FloatArray],
    undefined: str,
    comparison: Comparison | None,
    part: slice,
    enhanced: bool,
    threshold: float | None,
) -> Figure:
    """Draw some columns of profiles, and the photo's residual below them."""
    styles = {"simulation": SIMULATION, "band model": BAND, _PHOTO: PHOTO}
    figure = Figure(figsize=(7.2, 2.9 if comparison is None else 4.0))
    ratios = (1,) if comparison is None else (3, 1)
    axes = figure.subplots(
        len(ratios), 1, squeeze=False, sharex=True, gridspec_kw={"height_ratios": ratios}
    )[:, 0]
    column = np.arange(len(lines["simulation"]))[part]
    for name, style in styles.items():
        if name in lines:
            axes[0].plot(column, lines[name][part], label=name, linewidth=1.1, **style)
    if threshold is not None:
        axes[0].axhline(threshold, label="threshold", **THRESHOLD)
    axes[0].set(ylabel="enhanced level" if enhanced else "grey level", ylim=(0, None))
    if undefined:
        axes[0].set_title(undefined, fontsize=7, parse_math=False)
    if comparison is not None:
        axes[1].axhline(0.0, color="grey", linewidth=0.5)
        axes[1].plot(column, lines[_RESIDUAL][part], linewidth=0.9, color=colours.PHOTO)
        axes[1].set_ylabel("photo minus\nsimulation")
        message = f"correlation {comparison.correlation:.4f}, RMSE {comparison.rmse:.2f} levels"
        axis_limit = max(_AXIS_OF_RESIDUAL * comparison.usual_residual, 1.0)
        if comparison.largest_residual > axis_limit:
            axes[1].set_ylim(-axis_limit, axis_limit)
            message += f", at most {comparison.largest_residual:.0f}, beyond the axis"
        axes[1].set_title(message, fontsize=8)
    axes[-1].set_xlabel("column")
    figure.legend(loc="outside upper center", ncols=len(lines) + 1, frameon=False)
    return figure
