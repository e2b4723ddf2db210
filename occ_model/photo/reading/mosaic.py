"""The photosites of a sensor under a Bayer filter, and the light that the green ones saw.

Under a Bayer filter every line of the sensor, and every column, has a green photosite in each pair
of neighbours. So the picture is made of these alone: each stands for itself and for its neighbour
of another colour in the same line. No value is interpolated between lines, which were exposed at
different times, and a line of the picture is a line of the sensor: its readout time is that of the
sensor, not of a plane of half the lines.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.photo.reading.exif import CameraNotes
from occ_model.photo.reading.image_decoding import Samples

WHITE_SAMPLE = 65535
"""The sample value of the sensor's white level."""


@dataclass(frozen=True, eq=False, slots=True)
class Mosaic:
    """The photosites of a sensor, as they are stored."""

    photosites: NDArray[np.uint16]  # shape (lines, columns); their values as the camera wrote them
    # Shape (2, 2); which photosites of a square of four are taken; all of them where there are no
    # colours.
    is_green: NDArray[np.bool_]
    # The black and the white level of each photosite of a square, shape (2, 2, 2).
    levels: NDArray[np.float64]
    # notes, orientation: the camera's notes, and the EXIF orientation that the photosites still
    # have.
    notes: CameraNotes
    orientation: int

    @property
    def channel(self) -> str:
        """The name of the channel that is taken."""
        return "grey" if self.is_green.all() else "green"

    def one_plane(self) -> Samples:
        """Return one green photosite of each square of four, shape (lines / 2, columns / 2)."""
        row, column = np.argwhere(self.is_green)[0].tolist()
        return np.ascontiguousarray(self.photosites[row::2, column::2])

    def samples(self, along_lines: bool) -> Samples:
        """Return the light as a picture of the sensor's size, in proportion, 65535 being white.

        ``along_lines``: whether photosites of a line are of one time, else those of a column. A
        photosite of another colour has the value of its green neighbour of the same time.

        Shape (lines, columns).
        """
        picture = np.empty(self.photosites.shape, np.uint16)
        if along_lines:
            self._fill(picture, self.photosites, self.is_green, self.levels)
        else:
            levels = self.levels.transpose(0, 2, 1)
            self._fill(picture.T, self.photosites.T, self.is_green.T, levels)
        return picture

    def _fill(
        self,
        picture: NDArray[np.uint16],
        photosites: NDArray[np.uint16],
        is_green: NDArray[np.bool_],
        levels: NDArray[np.float64],
    ) -> None:
        for row in range(2):
            for column in range(2):
                to = picture[row::2, column::2]
                taken = column if is_green[row, column] else 1 - column
                light = _light_of(*levels[:, row, taken].tolist())
                found = light[photosites[row::2, taken::2]]
                width = min(to.shape[1], found.shape[1])
                to[:, :width] = found[:, :width]
                # The last of an odd number has its green neighbour on the other side.
                to[:, width:] = found[:, -1:]


def _light_of(black: float, white: float) -> NDArray[np.uint16]:
    """Return the sample of every value that a photosite can have, shape (65536,)."""
    share = np.clip((np.arange(65536) - black) / (white - black), 0.0, 1.0)
    light: NDArray[np.uint16] = np.rint(share * WHITE_SAMPLE).astype(np.uint16)
    return light
