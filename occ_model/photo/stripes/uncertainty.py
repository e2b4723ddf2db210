"""How sure a fit is of what it found."""

import numpy as np

from occ_model.arrays import FloatArray


def correlated_columns(residual: FloatArray) -> float:
    """Say how many columns of what a fit leaves unexplained make one independent number.

    1 + 2 times the sum of the autocorrelations up to the first that is not positive: what a model
    does not know, such as a lens's blur, is alike in neighbouring columns, and says so once only.

    Parameters
    ----------
    residual : ndarray of float64, shape (columns,)
        Data less model.
    """
    power = float(residual @ residual)
    if power <= 0.0:
        return 1.0
    spectrum = np.abs(np.fft.rfft(residual, 2 * len(residual))) ** 2
    alike = np.fft.irfft(spectrum)[1 : len(residual)] / power
    ends = np.flatnonzero(alike <= 0.0)
    return 1.0 + 2.0 * float(alike[: ends[0] if ends.size else None].sum())
