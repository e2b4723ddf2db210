"""Convert parts of a decoded picture to samples of 8 or 16 bits, without transparency."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from occ_model.camera.pixel_arrays import Samples, round_to_16_bits
from occ_model.photo.reading.levels import Levels

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage

_WHITE = 65535


def palette_of(picture: "PillowImage") -> Samples:
    """Return the colours of a picture's palette by index, shape (256, 3) or (256,)."""
    swatch = picture.crop((0, 0, 256, 1))
    swatch.frombytes(bytes(range(256)))
    colours: Samples = colours_of(swatch)[0]
    return colours


def colours_of(part: "PillowImage", levels: Levels | None = None) -> Samples:
    """Convert pixels of 8 bits, and put transparent ones on black."""
    from PIL import Image

    if levels is not None:
        part = part.point(levels.tabulate(255)[:256].tolist() * len(part.getbands()))
    visible = part
    if part.has_transparency_data:
        visible = part.convert("RGBA")
        if visible.getchannel("A").getextrema() != (255, 255):
            background = Image.new("RGBA", part.size, (0, 0, 0, 255))
            visible = Image.alpha_composite(background, visible)
    if visible.mode == "LAB":  # Pillow does not convert it to RGB
        visible = visible.getchannel("L")
    grey = visible.mode in ("1", "L")
    return np.asarray(visible.convert("L" if grey else "RGB"))


def convert_integers(part: "PillowImage", levels: Levels | None) -> Samples:
    """Convert integers to samples of 16 bits, without scaling to the picture's brightness."""
    values = np.asarray(part)
    if values.dtype.itemsize > 2:
        values = np.maximum(values, 0)
    values = values.astype(np.uint16)
    samples = values if levels is None else levels.tabulate(_WHITE)[values]
    transparent = part.info.get("transparency")
    if isinstance(transparent, int):
        samples[values == transparent] = 0
    return samples


def convert_floats(values: NDArray[Any], white: float, is_inverted: bool) -> Samples:
    """Convert floating point to samples of 16 bits; NaN becomes black."""
    return round_to_16_bits(white - values if is_inverted else values, white)


def put_on_black(pixels: NDArray[Any]) -> Samples:
    """Put pixels of 16 bits on black, shape (rows, columns) or (rows, columns, channels).

    Of two or four channels the last is the opacity, which is left out. The result has one channel,
    shape (rows, columns), or three.
    """
    if pixels.ndim == 3 and pixels.shape[2] in (2, 4):
        pixels, opacity = pixels[..., :-1], pixels[..., -1:]
        if opacity.min() < _WHITE:
            # Divide by 65535 and round, by shifts, as a division would take longer than all else.
            products = pixels.astype(np.uint32)
            products *= opacity
            products += 32768
            products += products >> 16
            products >>= 16
            pixels = products.astype(np.uint16)
    if pixels.ndim == 3 and pixels.shape[2] == 1:
        pixels = pixels[..., 0]
    return np.ascontiguousarray(pixels, np.uint16)
