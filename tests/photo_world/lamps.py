"""Lamps: how brightly each pixel sees one, without its blinking."""

from dataclasses import dataclass

import cv2
import numpy as np


@dataclass(frozen=True)
class Lamp:
    """A lamp in the picture."""

    shape: str  # ``"round"`` or ``"rectangular"``
    middle_row: float  # middle_row, middle_column, half_height, half_width: in pixels
    middle_column: float
    half_height: float
    half_width: float
    rim: float  # width of its rim in pixels, over which it fades
    darkening: float  # fraction of its light that is lost from its middle to its rim
    # halo, halo_size: fraction of its light that is scattered around it, and how far in pixels.
    halo: float
    halo_size: float

    def brightness(self, rows: int, columns: int) -> np.ndarray:
        """Return the light of each pixel while it is lit, about 1 at most, shape (rows, columns).

        Optical scattering moves light between places of the picture and not between times: the halo
        in a column blinks as the column's exposure sees it.
        """
        off = self._off(rows, columns)
        inside = np.clip(
            (1.0 - off) * min(self.half_height, self.half_width) / self.rim + 0.5, 0.0, 1.0
        )
        direct = inside * (1.0 - self.darkening * np.minimum(off, 1.0) ** 2)
        scattered = cv2.GaussianBlur(direct, (0, 0), self.halo_size)
        return np.asarray((1.0 - self.halo) * direct + self.halo * scattered)

    def covers(self, rows: int, columns: int) -> np.ndarray:
        """Say which pixels show the lamp itself, shape (rows, columns)."""
        return self._off(rows, columns) < 1.0

    def _off(self, rows: int, columns: int) -> np.ndarray:
        """Return how far each pixel is from its middle: 1 at its edge."""
        down = (np.arange(rows)[:, None] - self.middle_row) / self.half_height
        across = (np.arange(columns)[None, :] - self.middle_column) / self.half_width
        if self.shape == "round":
            return np.asarray(np.hypot(down, across))
        return np.asarray(np.maximum(np.abs(down), np.abs(across)))


def random_lamp(random: np.random.Generator, rows: int, columns: int) -> Lamp:
    """Draw a lamp that the picture shows most of."""
    shape = str(random.choice(["round", "rectangular"]))
    half_width = float(random.uniform(0.25, 0.6)) * columns
    half_height = float(random.uniform(0.3, 0.6)) * rows
    return Lamp(
        shape,
        rows * float(random.uniform(0.4, 0.6)),
        columns * float(random.uniform(0.4, 0.6)),
        half_height,
        half_width,
        rim=float(random.uniform(1.0, 20.0)),
        darkening=float(random.uniform(0.0, 0.6)),
        halo=float(random.uniform(0.0, 0.3)),
        halo_size=float(random.uniform(0.02, 0.2)) * rows,
    )
