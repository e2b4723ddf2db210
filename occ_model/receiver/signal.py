"""The signal of a region: its column means, and Otsu's threshold between zeros and ones."""

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.photometry import FLAT
from occ_model.results.decoding import Region

_BINS = 256

MAX_UNEXPLAINED = 0.05
"""Fraction of a signal's variance, neither its model's nor noise, above which it is another's.

Of packets that the equalizer had read rightly up to 3 %, of wrong ones as a rule more than 7 %.
"""

_MIN_VARIANCE = 1e-8  # of light in fractions of full light: no model is more exact

_WHOLE_ROWS = 2**23  # most rows whose sum of bytes fits an integer of 32 bits


def column_means(image: ByteArray, region: Region) -> FloatArray:
    """Average each column of a region, in grey levels."""
    part = region.crop(image)
    sums = np.zeros(region.columns)
    for first in range(0, region.rows, _WHOLE_ROWS):
        rows = part[first : first + _WHOLE_ROWS]
        sums += cv2.reduce(rows, 0, cv2.REDUCE_SUM, dtype=cv2.CV_32S)[0]
    return sums / region.rows


def why_flat(signal: FloatArray) -> str | None:
    """Return a sentence if a signal is too flat to show stripes, else None."""
    swing = float(signal.max() - signal.min())
    if swing >= FLAT:
        return None
    return f"No stripes: the signal spans only {swing:.2g} grey levels."


def otsu_split(counts: IndexArray) -> int | None:
    """Find the last bin of the lower class of a histogram; None where fewer than two are filled.

    The split maximises the variance between the classes (Otsu, IEEE Trans. SMC 9:62, 1979). Where
    several splits do, as when empty bins lie between the classes, the middle one is taken.
    """
    filled = np.flatnonzero(counts)
    if filled.size < 2:
        return None
    first = filled[0]
    # Summed from both ends, about the middle: the smallest class keeps its digits beside a large
    # one, and a histogram and its mirror image give the same numbers.
    counts = counts[first : filled[-1] + 1].astype(np.float64)
    moments = counts * (np.arange(len(counts)) - 0.5 * (len(counts) - 1))
    below, above = np.cumsum(counts)[:-1], np.cumsum(counts[::-1])[-2::-1]
    means = np.cumsum(moments)[:-1] / below, np.cumsum(moments[::-1])[-2::-1] / above
    between = below * above * (means[1] - means[0]) ** 2
    best = np.flatnonzero(between >= between.max() * (1.0 - 1e-12))
    return int(first + best[len(best) // 2])


def otsu_threshold(signal: FloatArray) -> float:
    """Find the grey level, in 256 bins, that separates ones from zeros in a signal."""
    low, high = float(signal.min()), float(signal.max())
    bins = np.rint((signal - low) * ((_BINS - 1) / (high - low))).astype(np.int64)
    split = otsu_split(np.bincount(bins, minlength=_BINS))
    assert split is not None  # noqa: S101 - the first bin and the last are filled
    return low + (split + 0.5) * (high - low) / (_BINS - 1)


def unexplained_fraction(signal: FloatArray, residual: FloatArray) -> float:
    """Return the fraction of a signal's variance that its model leaves, without the noise.

    Noise differs from each value to the next; what neighbours of the residual share is not noise.
    """
    left, seen = residual - residual.mean(), signal - signal.mean()
    return float(left[1:] @ left[:-1]) / max(float(seen @ seen), _MIN_VARIANCE * len(signal))
