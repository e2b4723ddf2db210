"""Turn and mirror pictures as a film's track states: ISO/IEC 14496-12, the matrix of ``tkhd``."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import Samples


@dataclass(frozen=True, slots=True)
class Orientation:
    """How to make a stored picture upright: swap its axes first, then reverse columns and lines."""

    are_axes_swapped: bool = False
    are_columns_reversed: bool = False
    are_lines_reversed: bool = False

    @classmethod
    def of_matrix(cls, content: bytes) -> "Orientation":
        """Return the nearest of the eight orientations to a matrix of nine numbers."""
        (a, b, _), (c, d, _), _ = np.frombuffer(content, np.int32).reshape(3, 3).tolist()
        if abs(a) + abs(d) >= abs(b) + abs(c):
            return cls(False, a < 0, d < 0)
        return cls(True, c < 0, b < 0)

    def turn(self, pixels: Samples) -> Samples:
        """Return a picture, shape (lines, columns) or (lines, columns, 3), upright."""
        pixels = pixels.swapaxes(0, 1) if self.are_axes_swapped else pixels
        pixels = pixels[:, ::-1] if self.are_columns_reversed else pixels
        return np.ascontiguousarray(pixels[::-1] if self.are_lines_reversed else pixels)

    @property
    def line_axis(self) -> int:
        """The axis of an upright picture along which the stored lines follow each other."""
        return int(self.are_axes_swapped)

    @property
    def is_last_line_first(self) -> bool:
        """Whether the stored picture's last line is the upright picture's first."""
        return self.are_columns_reversed if self.are_axes_swapped else self.are_lines_reversed
