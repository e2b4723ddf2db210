"""The panel's rims in a sample of the pixels, and how effects move them."""

from functools import cached_property

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.effect import PaperView
from occ_model.effects.sample import PixelSample

_SEEN_FRACTION = 0.003  # smallest change of the panel's fraction that can change a pixel's level


class Rims:
    """The rims of a scene's panel; a panel that covers the whole picture has none."""

    def __init__(self, view: PaperView, sample: PixelSample) -> None:
        self._region, self._camera = view.region, view.scene.camera
        self.is_upright = view.sides is not None  # an upright rectangle in the picture
        self._sample = sample
        self.rows = view.region.rows

    @property
    def blocks(self) -> int:
        """Number of JPEG blocks that the panel touches in a column."""
        return -(-self._region.last_row // 8) - self._region.first_row // 8

    @property
    def cut_variance(self) -> float:
        """Variance of a column's sum of JPEG rounding errors, in variances of a pixel's error.

        Only the blocks that the panel's first and last row cut contribute: over the rows of a whole
        block the errors add to 0.
        """
        ends = self._region.first_row % 8, self._region.last_row % 8
        return sum(rows * (8 - rows) / 8.0 for rows in ends)

    @cached_property
    def fractions(self) -> tuple[float, float]:
        """Fractions of the pixels in JPEG blocks at a rim along the rows, and at an upright rim.

        A slanting rim counts as both. On average a rim leaves half of a block's 8 rows or columns
        in the region.
        """
        region, camera = self._region, self._camera
        if self._sample.is_covered:
            return 0.0, 0.0
        ends = (region.first_row > 0) + (region.last_row < camera.rows)
        sides = (region.first_column > 0) + (region.last_column < camera.columns)
        if not self.is_upright:
            ends = sides = 2
        return min(1.0, 4.0 * ends / region.rows), min(1.0, 4.0 * sides / region.columns)

    @property
    def fraction(self) -> float:
        """The fraction of the pixels in blocks at any rim."""
        return min(1.0, sum(self.fractions))

    def _cover_change(self, name: str) -> FloatArray | None:
        """Return what an effect adds to the panel's fraction of each pixel; None if nothing.

        All other effects that move or blur the rims are taken to be simulated.
        """
        covers, outline = self._sample.covers, self._sample.outline
        complete, without = covers[outline], covers[outline - {name}]
        if complete is without or complete is None or without is None:
            return None
        return complete - without

    def count_moved_rims(self, name: str) -> float:
        """Return how many rims of a column, 0 to 2, an effect moves or softens on average."""
        change, sample = self._cover_change(name), self._sample
        if change is None:
            return 0.0
        is_visible = np.abs(change) > _SEEN_FRACTION
        middle = (sample.inner.start + sample.inner.stop) // 2
        above, below = is_visible[:, :middle].any(axis=1), is_visible[:, middle:].any(axis=1)
        return float(((above * 1.0 + below) * sample.weights).sum())

    def upright_rim_error(self, name: str) -> float:
        """Return the mean square error of the fraction of a column's rows that the panel covers.

        An upright rim that an effect moves may pass some of a column's few nodes and not others;
        their mean then errs by up to a third of the change.
        """
        change = self._cover_change(name)
        if change is None:
            return 0.0
        spans = np.ptp(change[:, self._sample.inner], axis=1)
        return float(spans**2 @ self._sample.weights) / 9.0
