"""A Bayer mosaic: pixels behind filters of three colours, demosaiced, and stored as a colour file.

Interpolation is linear in light, so the mosaic is converted from grey levels to light first. OpenCV
has its VNG for 8 bits only; it interpolates the grey levels themselves.

Bilinear demosaicing of stripes of frequency f (in cycles a second; t_r apart) has closed forms, as
means over the rows: red and blue keep cos^2(pi f t_r) of the stripe, and get an image of it with
sin^2(pi f t_r) at |1 / (2 t_r) - f|, opposite in red and blue; green keeps 3/4 + 1/4 cos(2 pi f
t_r).
"""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.errors import ParameterError
from occ_model.scene.scene import Scene

_FULL = 65535.0  # light of a white pixel in 16 bits
_SAMPLINGS = {
    "subsampled": cv2.IMWRITE_JPEG_SAMPLING_FACTOR_420,
    "full": cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444,
}
_BAND, _NEIGHBOURS = 32, 4  # rows that are converted at once, and rows on which one may depend
_LEAST_SIDE = 4  # pixels of a side that can be demosaiced
_METHODS = {"bilinear": "", "vng": "_VNG", "edge-aware": "_EA"}


@lru_cache(maxsize=4)
def light_of_greys(gamma: float) -> FloatArray:
    """Return the light of each grey level as a fraction of white's, shape (256,)."""
    light: FloatArray = (np.arange(256.0) / WHITE) ** gamma
    light.flags.writeable = False
    return light


@lru_cache(maxsize=4)
def _tables(gamma: float) -> tuple[NDArray[np.uint16], ByteArray]:
    """Return the 16-bit light of each grey level, and the grey level of each light.

    Dark levels get lights of their own, however small, so that none is changed by the two.
    """
    grey = np.arange(256)
    light = np.rint(_FULL * light_of_greys(gamma)).astype(np.int64)
    light = grey + np.maximum.accumulate(light - grey)
    ends = np.clip(_FULL * ((grey[:-1] + 0.5) / WHITE) ** gamma, light[:-1], light[1:] - 1)
    greys = np.searchsorted(ends, np.arange(_FULL + 1.0), side="left")
    return light.astype(np.uint16), greys.astype(np.uint8)


def demosaic(mosaic: ByteArray, scene: Scene) -> ByteArray:
    """Return a colour picture of a raw one, shape (rows, columns, 3): red, green, blue."""
    method, gamma = scene.colours.demosaicing, scene.camera.gamma
    if min(mosaic.shape) < _LEAST_SIDE:
        raise ParameterError.of(
            "demosaicing", method, "none",
            condition=f"for a picture of fewer than {_LEAST_SIDE} rows or columns",
            parameters=("demosaicing", "rows", "columns"),
        )  # fmt: skip
    code = getattr(cv2, f"COLOR_Bayer{scene.colours.bayer.upper()}2RGB{_METHODS[method]}")
    if method == "vng":
        return np.asarray(cv2.demosaicing(mosaic, code), dtype=np.uint8)
    light, greys = _tables(gamma)
    picture = np.empty((*mosaic.shape, 3), dtype=np.uint8)
    # Bands stay in the processor's cache; their neighbours' rows make no difference beyond a few.
    for first in range(0, len(mosaic), _BAND):
        above = min(first, _NEIGHBOURS)
        part = mosaic[first - above : first + _BAND + _NEIGHBOURS]
        full = np.asarray(cv2.demosaicing(cv2.LUT(part, light), code), dtype=np.uint16)
        target = picture[first : first + _BAND]
        # No 16-bit light is out of range: the mode only saves a copy.
        greys.take(full[above : above + len(target)], out=target, mode="wrap")
    return picture


def mosaic_of(image: ByteArray, scene: Scene) -> ByteArray:
    """Return what each pixel saw behind its own filter; a raw picture is returned as it is.

    Bilinear demosaicing keeps these values, and a compressed file nearly does.
    """
    if image.ndim == 2:
        return image
    mosaic = np.empty(image.shape[:2], dtype=image.dtype)
    for channel, own in scene.colours.filters:
        mosaic[own] = image[(*own, channel)]
    return mosaic


def store_as_jpeg(image: ByteArray, quality: int, chroma: str) -> ByteArray:
    """Return a colour picture as read from a JPEG file with ``"full"`` or ``"subsampled"`` chroma.

    Where the chroma has lost a stripe, all channels hold its luma alone: 0.299,
    0.587 and 0.114 of the red, green and blue stripes (ITU-R BT.601).
    """
    sampling = _SAMPLINGS[chroma]
    options = [
        cv2.IMWRITE_JPEG_QUALITY, quality, cv2.IMWRITE_JPEG_SAMPLING_FACTOR, sampling,
    ]  # fmt: skip
    _, file = cv2.imencode(".jpg", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), options)
    read = np.asarray(cv2.imdecode(file, cv2.IMREAD_COLOR), dtype=np.uint8)
    return np.asarray(cv2.cvtColor(read, cv2.COLOR_BGR2RGB), dtype=np.uint8)
