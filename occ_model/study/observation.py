"""What a decoder gets to see of a scene, with noise: by way of the image, or without one.

The profile path needs no image. A level panel shows the same column values in every one of its
rows, so that the mean of a column is known without its pixels: the noise, sent through the
enhancement as each pixel would send it, and averaged over as many rows.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.enhancement import enhancement_of, to_bytes
from occ_model.camera.photometry import WHITE, column_profile, level_values
from occ_model.camera.projection import paint, panel_corners, row_spans
from occ_model.receiver.decode import decode
from occ_model.receiver.locate import bright_level
from occ_model.results import DecodeResult, Region
from occ_model.scene import Scene

_GRID = 8
"""Steps a grey level is divided into where the noise is sent through the enhancement."""

_REACH = 5.0
"""Standard deviations after which the noise's distribution is cut off."""


def noisy_image(scene: Scene, noise: float, random: np.random.Generator) -> ByteArray:
    """Make the image with noise of its own in each pixel, before the enhancement.

    Parameters
    ----------
    scene
        The scene.
    noise
        Standard deviation of a pixel's noise in grey levels.
    random
        Where the noise comes from.

    Returns
    -------
    ndarray of uint8, shape (rows, columns)
    """
    corners = panel_corners(scene)
    profile = column_profile(scene)
    curve = enhancement_of(profile, scene.model.enhancement)
    dark = float(level_values(scene)[0])
    rows = scene.camera.rows
    image = paint(curve(profile), corners, rows, int(to_bytes(np.array(dark))))
    first, last = row_spans(corners, rows, len(profile))
    for row in range(rows if noise > 0.0 else 0):
        # Single precision: noise needs no more, and it is drawn twice as fast.
        deviations = noise * random.standard_normal(len(profile), dtype=np.float32)
        panel = slice(int(first[row]), int(last[row]))
        image[row] = to_bytes(dark + deviations)
        image[row, panel] = curve(profile[panel] + deviations[panel])
    return image


def decode_profile(
    scene: Scene, decoder: str, noise: float, random: np.random.Generator
) -> DecodeResult | None:
    """Decode what the image of a level panel would show, without the image.

    The decoder's region is found as in the image: from the first bright column to the last.

    Parameters
    ----------
    scene
        The scene.
    decoder
        The decoder's name.
    noise, random
        As for :func:`noisy_image`.

    Returns
    -------
    DecodeResult or None
        None where the panel's picture is not level, so that its rows differ.
    """
    corners = panel_corners(scene)
    rows, columns = scene.camera.rows, scene.camera.columns
    first, last = row_spans(corners, rows, columns)
    lit_rows = np.flatnonzero(last > first)
    if lit_rows.size and np.ptp(first[lit_rows]) + np.ptp(last[lit_rows]) > 0:
        return None
    profile = column_profile(scene)
    curve = enhancement_of(profile, scene.model.enhancement)
    if lit_rows.size == 0:
        return decode(np.full(columns, float(level_values(scene)[0])), scene, decoder)
    left, right = int(first[lit_rows[0]]), int(last[lit_rows[0]])
    panel = profile[left:right]
    bright = _bright_span(scene, curve(panel), lit_rows.size)
    if bright is not None:
        left, panel = left + bright.start, panel[bright]
    signal = _noisy_means(panel, curve, noise, lit_rows.size, random)
    result = decode(signal, scene, decoder)
    top = int(lit_rows[0])
    region = Region(top, top + lit_rows.size, left, left + len(panel))
    return replace(result, region=region)


def _bright_span(scene: Scene, panel: ByteArray, lit_rows: int) -> slice | None:
    """Find the columns from the first bright one to the last, as in the whole image."""
    counts = np.bincount(panel, minlength=256).astype(np.int64) * lit_rows
    pixels = scene.camera.rows * scene.camera.columns
    surroundings = int(to_bytes(level_values(scene))[0])
    counts[surroundings] += pixels - len(panel) * lit_rows
    level = bright_level(counts, scene.receiver.bright_fraction)
    if level is None:
        return None
    bright = np.flatnonzero(panel >= level)
    return slice(int(bright[0]), int(bright[-1]) + 1) if bright.size else None


def _noisy_means(
    panel: FloatArray,
    curve: Callable[[FloatArray], ByteArray],
    noise: float,
    rows: int,
    random: np.random.Generator,
) -> FloatArray:
    """Average noisy, enhanced pixels over rows, by the distribution that they have."""
    if noise * _GRID * _REACH < 1.0:  # nothing that the steps could show
        return curve(panel).astype(np.float64)
    reach = int(np.ceil(_REACH * noise * _GRID))
    offsets = np.arange(-reach, reach + 1) / _GRID
    weights = np.exp(-0.5 * (offsets / noise) ** 2)
    weights /= weights.sum()
    levels = np.arange(-reach, int(WHITE) * _GRID + reach + 1) / _GRID
    enhanced = curve(levels).astype(np.float64)
    mean = np.convolve(enhanced, weights, mode="valid")
    variance = np.convolve(enhanced**2, weights, mode="valid") - mean**2
    inner = levels[reach : len(levels) - reach]
    spread = np.sqrt(np.maximum(np.interp(panel, inner, variance), 0.0) / rows)
    means: FloatArray = np.interp(panel, inner, mean)
    means += random.normal(0.0, 1.0, len(panel)) * spread
    return means
