"""Otsu's threshold: the split of a histogram that parts its two classes the most."""

import numpy as np

from occ_model.arrays import IndexArray


def otsu_split(counts: IndexArray) -> int | None:
    """Find the last bin of the lower class.

    The split maximises the variance between the classes (Otsu, IEEE Trans. SMC 9:62, 1979). Where
    several splits do, as when empty bins lie between the classes, the middle one is taken.

    Parameters
    ----------
    counts : ndarray of int64, shape (bins,)
        The histogram.

    Returns
    -------
    int or None
        None where fewer than two bins are filled.
    """
    weight = np.cumsum(counts, dtype=np.float64)
    moment = np.cumsum(counts * np.arange(len(counts), dtype=np.float64))
    splits = np.flatnonzero((weight > 0.0) & (weight < weight[-1]))
    if splits.size == 0:
        return None
    w, m = weight[splits] / weight[-1], moment[splits] / weight[-1]
    between = (moment[-1] / weight[-1] * w - m) ** 2 / (w * (1.0 - w))
    best = splits[between >= between.max() * (1.0 - 1e-12)]
    return int(best[len(best) // 2])
