"""The mean of the panel's pixels in each column, from some rows at a time."""

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.picture_rows import Rows


class ColumnMeans:
    """The mean of the panel's pixels in each column."""

    def __init__(self, columns: int) -> None:
        self._sums = np.zeros(columns)
        self._counts = np.zeros(columns, dtype=np.int64)

    def add(self, rows: Rows, values: Pixels | ByteArray) -> None:
        """Add the panel's pixels of some rows, in grey levels."""
        for columns in rows.inside:
            self._sums[columns] += _column_sums(values[:, columns])
            self._counts[columns] += len(values)
        for rim in rows.rims:
            seen = np.where(rim.inside, values[:, rim.columns], values.dtype.type(0))
            self._sums[rim.columns] += _column_sums(seen)
            self._counts[rim.columns] += np.count_nonzero(rim.inside, axis=0)

    def include(self, other: "ColumnMeans") -> None:
        self._sums += other._sums
        self._counts += other._counts

    def means(self, otherwise: FloatArray) -> FloatArray:
        means = self._sums / np.maximum(self._counts, 1)
        return np.asarray(np.where(self._counts > 0, means, otherwise))


def _column_sums(values: Pixels | ByteArray) -> FloatArray:
    # Bytes are summed as integers, many times faster; a picture has too few rows to exceed 32 bits.
    exact = cv2.CV_32S if values.dtype == np.uint8 else cv2.CV_64F
    sums = cv2.reduce(values, 0, cv2.REDUCE_SUM, dtype=exact)
    return np.asarray(sums[0], dtype=np.float64)
