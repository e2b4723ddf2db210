"""A simulated picture, with smaller ones of it that are quick to draw."""

from dataclasses import dataclass
from typing import Self

import cv2
import numpy as np

from occ_model.arrays import ByteArray
from occ_model.results import Frame

_SMALLEST = 256
"""Pixels a side below which a picture is drawn quickly as it is."""


@dataclass(frozen=True, eq=False, slots=True)
class Picture:
    """A simulated picture before it has been read.

    Parameters
    ----------
    frame
        The picture.
    halves : tuple of ndarray of uint8
        The picture at a half of its size, a quarter and so on: each pixel the mean of four.
    """

    frame: Frame
    halves: tuple[ByteArray, ...]

    @classmethod
    def of(cls, frame: Frame) -> Self:
        """Make the smaller ones, off the window's thread."""
        halves = []
        pixels = frame.image
        while min(pixels.shape) >= 2 * _SMALLEST:
            pixels = halved(pixels)
            halves.append(pixels)
        return cls(frame, tuple(halves))


def halved(pixels: ByteArray) -> ByteArray:
    """Average squares of four pixels; an odd row or column at the edge is left out.

    It is what OpenCV averages many times faster than any other ratio.
    """
    half = (pixels.shape[1] // 2, pixels.shape[0] // 2)
    even = pixels[: 2 * half[1], : 2 * half[0]]
    return np.asarray(cv2.resize(even, half, interpolation=cv2.INTER_AREA), dtype=np.uint8)
