"""Draw a photo over a simulated picture: blended, below a line, or as the difference."""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from occ_model import colours
from occ_model.arrays import FloatArray


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
    gain: int  # The factor by which it is multiplied in the drawing; more than 255 is white

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
        drawn = np.minimum(self.gain * self.levels, 255.0)
        ax.imshow(drawn, cmap="gray", vmin=0, vmax=255, extent=self.extent)


def lay_over(ax: Axes, cells: FloatArray, layer: PhotoLayer, shape: tuple[int, ...]) -> None:
    """Draw the cells of a part of a photo over the drawn picture, inside its limits."""
    limits = ax.get_xlim(), ax.get_ylim()
    rows, columns = shape
    extent = layer.extent(rows, columns, layer.first_row(rows))
    ax.imshow(cells, cmap="gray", vmin=0, vmax=255, alpha=layer.opacity, extent=extent)
    if layer.from_row is not None:
        ax.axhline(layer.from_row, color=colours.REGION, linewidth=1.0)
    ax.set_xlim(limits[0])
    ax.set_ylim(limits[1])
