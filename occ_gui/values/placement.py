"""Placement of a photo on the simulated picture: its shift and scale."""

from dataclasses import dataclass, replace
from typing import Self

MODES = ("beside", "blend", "split", "difference")
"""Ways of showing a photo with the simulated picture."""

LEAST_SCALE, LARGEST_SCALE = 0.01, 100.0


@dataclass(frozen=True, slots=True)
class Placement:
    column: float = 0.0  # the pixel of the simulated picture under the photo's first pixel
    row: float = 0.0
    scale: float = 1.0  # pixels of the simulated picture per pixel of the photo

    def within_limits(self) -> Self:
        """Give it a scale that is neither too small nor too large."""
        return replace(self, scale=min(max(self.scale, LEAST_SCALE), LARGEST_SCALE))
