"""Count the grey levels of a picture."""

import cv2
import numpy as np

from occ_model.arrays import ByteArray
from occ_model.results.spectrum import LEVELS, LevelHistogram


def level_histogram(image: ByteArray) -> LevelHistogram:
    """Count the grey levels of a picture."""
    if not image.size:
        return LevelHistogram(np.zeros(LEVELS))
    counts = cv2.calcHist([np.ascontiguousarray(image)], [0], None, [LEVELS], [0, LEVELS])
    return LevelHistogram(counts.ravel().astype(np.float64) / image.size)
