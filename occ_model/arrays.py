"""Types of arrays: floating point, indices, bytes, pixels, truth values."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int64]
ByteArray = NDArray[np.uint8]
Samples = NDArray[np.uint8 | np.uint16]  # 8 or 16 bits, with white as the largest number
Pixels = NDArray[np.float32]
BoolArray = NDArray[np.bool_]

LARGEST_BYTE = 255.0  # white in a picture of bytes
