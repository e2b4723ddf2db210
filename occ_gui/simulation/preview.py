"""Preview: a simulated picture before it is decoded, with smaller copies for fast drawing."""

from dataclasses import dataclass
from typing import Self

import cv2
import numpy as np

from occ_gui.simulation.snapshot import Reading
from occ_gui.values.simulated import SimulationRequest
from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.frame import Frame

_MIN_COPY_SIDE = 256
"""Pixels of a side; smaller pictures are drawn fast enough without smaller copies."""


@dataclass(frozen=True, eq=False, slots=True)
class PictureView:
    """The pixels of a picture, of a scene or of a frame of a film, and where they lie."""

    image: ByteArray  # shape (len(rows), columns): The pixels
    rows: range  # the rows of the whole picture that they show; a draft has some of them
    size: tuple[int, int]
    # Shape (4, 2): the panel's corners in the whole picture, each as (column, row)
    corners: FloatArray
    smallest: ByteArray  # the same pixels, or a copy of fewer

    def seen_by(self, _whose: str) -> Self:
        return self


@dataclass(frozen=True, eq=False, slots=True)
class Picture:
    """A simulated picture that has not been decoded yet."""

    frame: Frame
    whose: str  # whose picture of the frame it is, the ``"camera"``'s or the ``"receiver"``'s
    # The picture at a half of its size, at a quarter and so on; each pixel is the
    # mean of four
    halves: tuple[ByteArray, ...]
    # The scene and the settings that it was simulated from, where they are known
    request: SimulationRequest | None = None
    # What is shown of the same scene together with the picture, where that is known already
    reading: Reading | None = None

    @property
    def is_draft(self) -> bool:
        return self.frame.rows_step > 1

    def seen_by(self, whose: str) -> PictureView:
        """Return the pixels of the camera's picture or of the receiver's."""
        frame, camera = self.frame, self.frame.scene.camera
        image = frame.picture(whose)
        smallest = self.halves[-1] if self.halves and self.whose == whose else image
        return PictureView(
            image, frame.rows, (camera.rows, camera.columns), frame.corners, smallest
        )

    @classmethod
    def of(
        cls,
        frame: Frame,
        whose: str,
        request: SimulationRequest | None = None,
        reading: Reading | None = None,
    ) -> Self:
        """Compute the smaller copies; to be called on a background thread."""
        halves = []
        pixels = frame.picture(whose)
        while min(pixels.shape) >= 2 * _MIN_COPY_SIDE:
            pixels = halved(pixels)
            halves.append(pixels)
        return cls(frame, whose, tuple(halves), request, reading)


def halved(pixels: ByteArray) -> ByteArray:
    """Average squares of four pixels; an odd row or column at the edge is left out.

    For this ratio OpenCV is many times faster than for any other.
    """
    half = (pixels.shape[1] // 2, pixels.shape[0] // 2)
    even = pixels[: 2 * half[1], : 2 * half[0]]
    return np.asarray(cv2.resize(even, half, interpolation=cv2.INTER_AREA), dtype=np.uint8)
