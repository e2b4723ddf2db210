"""A lamp found in a photo."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.results.decoding import Region
from occ_model.scene.units import PERCENT

_MIN_PERIODS = 2.5  # periods in view; two bright objects can look like two periods
_MAX_RELATIVE_ERROR = 0.01 / 3.0  # of a frequency: three standard deviations are 1 %


@dataclass(frozen=True, eq=False, slots=True)
class Lamp:
    """A lamp in a photo.

    Parameters
    ----------
    region
        The smallest rectangle around it.
    spans : ndarray of int64, shape (strips, 4)
        Its shape as a stack of rectangles: first row, end row, first column and end column of each.
    level
        Its grey level when lit.
    modulated
        Whether stripes were found in it.
    period
        Period of its stripes in columns; None without stripes, or if they do not repeat.
    period_uncertainty
        Its standard deviation in columns.
    switching_frequency_times_readout
        Product of switching frequency and readout time, in chips per column; None without stripes.
        A repeated pulse counts as two chips a cycle, however short it is.
    product_uncertainty
        Its standard deviation in chips per column.
    periods
        Number of periods in view; None without a period.
    is_faint
        Whether it may be a reflection, as it is faint compared with the brightest lamp that has
        stripes.
    is_blurred
        Whether its stripes have little contrast, for example because the exposure is longer than a
        chip; edges may be missing and the frequency wrong.
    is_joined
        Whether it was found in parts that look like pulses, and by what is lit between them sends a
        code: of that, pulses can have another chip.
    reflections
        Fainter regions that blink in phase with the lamp.
    """

    region: Region
    spans: IndexArray
    level: float
    modulated: bool
    period: float | None = None
    period_uncertainty: float | None = None
    switching_frequency_times_readout: float | None = None
    product_uncertainty: float | None = None
    periods: float | None = None
    is_faint: bool = False
    is_blurred: bool = False
    is_joined: bool = False
    reflections: tuple[Region, ...] = ()

    @property
    def doubts(self) -> tuple[str, ...]:
        """Reasons why it may not be a lamp, or may blink differently, each without a full stop."""
        doubts = []
        if self.modulated and self.periods is not None and self.periods < _MIN_PERIODS:
            doubts.append(
                f"only {self.periods:.1f} periods are visible, which may be a coincidence"
            )
        if self.is_faint:
            doubts.append("it is much fainter than the brightest lamp and may be a reflection")
        if self.is_blurred:
            doubts.append("its stripes have so little contrast that some may be missing")
        if self.is_joined:
            doubts.append("its parts look like pulses, which can have another chip than their code")
        product, error = self.switching_frequency_times_readout, self.product_uncertainty
        if product is not None and error is not None and error > _MAX_RELATIVE_ERROR * product:
            doubts.append(f"its frequency is known only to {PERCENT.format(error / product, 2)}")
        return tuple(doubts)

    @property
    def is_doubtful(self) -> bool:
        """Whether there is a reason to doubt it."""
        return bool(self.doubts)

    @property
    def area(self) -> int:
        """Number of its pixels."""
        first, last, left, right = self.spans.T
        return int(((last - first) * (right - left)).sum())

    @property
    def outline(self) -> FloatArray:
        """The corners of its shape in order, shape (corners, 2): column and row."""
        first, last, left, right = self.spans.T.astype(np.float64)
        rows = np.column_stack([first, last]).ravel()
        down = np.column_stack([np.repeat(right, 2), rows])
        up = np.column_stack([np.repeat(left, 2), rows])[::-1]
        # The first pixel's centre is at (0, 0).
        return np.vstack([down, up, down[:1]]) - 0.5

    def covers(self, row: float, column: float) -> bool:
        """Return whether a pixel belongs to the lamp."""
        first, last, left, right = self.spans.T
        return bool(np.any((first <= row) & (row < last) & (left <= column) & (column < right)))
