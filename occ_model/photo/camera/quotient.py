"""The quotient of two pictures of one room, in which the room cancels and the bars stay.

If there is one picture, the medians of its columns are the other, which cancels an even wall.
"""

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np

from occ_model.arrays import BoolArray, FloatArray
from occ_model.camera.pixel_arrays import Samples
from occ_model.photo.reading.load import Photo

TILES = 6
"""Tiles of columns. Each has a phase of its own, as lamps hang on different phases of the mains."""

_MOST_LINES, _MOST_COLUMNS = 270, 240  # cells to which pictures are reduced; bars are much longer
_FEWEST_CELLS = 4  # cells of a line in a tile that make a value
_WHITE = 250.0 / 255.0  # pixel values above are clipped
_DARKEST = 16.0 / 255.0  # pixel value of the pair's mean below which quantization and noise reign
_MOST_SHIFT = 0.1  # fraction of the picture by which two pictures of one place are shifted at most
_LEAST_RESPONSE = 0.1  # peak of the phase correlation below which the pictures share no texture
_OUTLIER = 3.0  # standard deviations beyond which cells of a line do not count


@dataclass(frozen=True, eq=False, slots=True)
class LineValues:
    """How the light of the lines changes between two pictures, in tiles of columns.

    Parameters
    ----------
    values : ndarray of float64, shape (tiles, lines)
        (A - B) / (A + B) of the two pictures' light A and B, the mean of a tile's line; 0 where
        nothing is seen.
    deviations : ndarray of float64, shape as ``values``
        Their standard deviations by the scatter within the line; infinite where nothing is seen.
    places : ndarray of float64, shape (tiles,)
        Middles of the tiles in picture widths from the middle of the picture.
    lines, columns
        Size of the picture in pixels; lines are read one after the other.
    """

    values: FloatArray
    deviations: FloatArray
    places: FloatArray
    lines: int
    columns: int

    @property
    def seen(self) -> float:
        """Fraction of the tiles' lines that have a value."""
        return float(np.isfinite(self.deviations).mean())

    def weights(self, least: float) -> FloatArray:
        """Return inverse variances with a ``least`` deviation, 0 where nothing is seen."""
        return np.asarray(1.0 / (self.deviations**2 + least**2))

    def positions(self, bend: float) -> FloatArray:
        """Return the places of the lines in the frame, of shape (tiles or 1, lines).

        They are 0 to 1, before a lens correction moved them by ``bend`` of their distance from the
        middle, in the picture's corners.
        """
        count, height = self.values.shape[1], self.lines / self.columns
        middle = (np.arange(count) + 0.5) / count - 0.5
        if bend == 0.0:
            return np.asarray(0.5 + middle[None, :])
        square = (middle[None, :] * height) ** 2 + self.places[:, None] ** 2
        return np.asarray(0.5 + middle * (1.0 + bend * square / (0.25 * (1.0 + height**2))))


@dataclass(frozen=True, eq=False, slots=True)
class _Light:
    """A picture's light in cells, 1 at white, and which cells have no clipped pixel."""

    light: FloatArray
    is_clear: FloatArray  # 1 or 0


def quotient_of_lines(photos: list[Photo], scan_axis: str) -> LineValues:
    """Divide the light of two photos, or of one and its columns' medians, line by line.

    Parameters
    ----------
    photos
        One or two of the same size.
    scan_axis
        ``"lines"`` or ``"columns"`` of the upright photo: what the camera reads one by one.
    """
    first, *others = [_in_cells(photo, scan_axis) for photo in photos]
    second = _align(first, others[0]) if others else _columns_medians(first)
    return LineValues(*_tiles(*_quotient(first, second)), *_upright(photos[0], scan_axis).shape)


def light_of(values: FloatArray) -> FloatArray:
    """Return the light of pixel values from 0 to 1, by the curve of sRGB (IEC 61966-2-1)."""
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def _upright(photo: Photo, scan_axis: str) -> Samples:
    """Return the samples with the lines that are read one by one as the rows."""
    return photo.samples if photo.turned != (scan_axis == "lines") else photo.samples.T


def _in_cells(photo: Photo, scan_axis: str) -> _Light:
    samples = _upright(photo, scan_axis)
    levels = np.arange(photo.white + 1) / photo.white
    table = (levels if photo.is_linear else light_of(levels)).astype(np.float32)
    size = (min(samples.shape[1], _MOST_COLUMNS), min(samples.shape[0], _MOST_LINES))
    clipped = (samples > _WHITE * photo.white).astype(np.float32)
    light, part = (
        np.asarray(cv2.resize(each, size, interpolation=cv2.INTER_AREA), dtype=np.float64)
        for each in (table[samples], clipped)
    )
    return _Light(light, (part < 1e-3).astype(np.float64))


def _columns_medians(one: _Light) -> _Light:
    seen = np.where(one.is_clear > 0.0, one.light, np.nan)
    seen[:, np.all(np.isnan(seen), axis=0)] = 0.0
    medians = np.nanmedian(seen, axis=0)
    return _Light(np.broadcast_to(medians, one.light.shape), np.ones_like(one.light))


def _align(first: _Light, second: _Light) -> _Light:
    """Shift the second picture onto the first by their texture, without the lines' means."""
    window = cv2.createHanningWindow(first.light.shape[::-1], cv2.CV_64F)
    (across, down), response = cv2.phaseCorrelate(
        _texture(first.light), _texture(second.light), window
    )
    rows, columns = first.light.shape
    is_far = abs(across) > _MOST_SHIFT * columns or abs(down) > _MOST_SHIFT * rows
    if response < _LEAST_RESPONSE or is_far:
        return second
    matrix = np.array([[1.0, 0.0, -across], [0.0, 1.0, -down]])
    light, clear = (
        np.asarray(cv2.warpAffine(each, matrix, (columns, rows), flags=cv2.INTER_LINEAR), float)
        for each in (second.light, second.is_clear)
    )
    return _Light(light, (clear > 0.999).astype(np.float64))


def _texture(light: FloatArray) -> FloatArray:
    logarithm = np.log(light + 0.01)
    logarithm = logarithm - np.median(logarithm, axis=1, keepdims=True)
    return np.asarray(logarithm - cv2.GaussianBlur(logarithm, (0, 0), 6.0))


def _quotient(first: _Light, second: _Light) -> tuple[FloatArray, BoolArray]:
    """Return (A - B) / (A + B), with B scaled to A's usual brightness, and where it is seen."""
    dark = float(light_of(np.array(_DARKEST)))
    is_clear = (first.is_clear * second.is_clear > 0.0) & (second.light > 0.0)
    is_bright = is_clear & (first.light + second.light > 2.0 * dark)
    ratios = first.light[is_bright] / second.light[is_bright]
    scale = float(np.median(ratios)) if ratios.size else 1.0
    # Where the first picture is mostly dark, as between deep bars, its bright part decides.
    scale = max(scale, 0.25 * float(np.quantile(ratios, 0.9))) if ratios.size else 1.0
    other = scale * second.light
    total = first.light + other
    is_seen = is_clear & (total > 2.0 * dark * min(1.0, scale))
    return np.where(is_seen, (first.light - other) / np.maximum(total, 1e-9), 0.0), is_seen


def _tiles(quotient: FloatArray, is_seen: BoolArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Average the quotient over the columns of each tile, without outliers."""
    ends = np.linspace(0, quotient.shape[1], TILES + 1).round().astype(int)
    values, deviations = [], []
    for first, last in pairwise(ends):
        seen = np.where(is_seen[:, first:last], quotient[:, first:last], np.nan)
        count = np.isfinite(seen).sum(axis=1)
        is_enough = count >= max(1, min(_FEWEST_CELLS, last - first))
        seen[~is_enough] = 0.0
        middle = np.nanmedian(seen, axis=1, keepdims=True)
        away = np.abs(seen - middle)
        spread = 1.4826 * np.nanmedian(away, axis=1, keepdims=True)
        kept = np.where(away <= _OUTLIER * spread + 1e-3, seen, np.nan)
        left = np.maximum(np.isfinite(kept).sum(axis=1), 1)
        values.append(np.nanmean(kept, axis=1))
        deviations.append(np.where(is_enough, np.nanstd(kept, axis=1) / np.sqrt(left), np.inf))
    places = 0.5 * (ends[1:] + ends[:-1]) / quotient.shape[1] - 0.5
    return np.array(values), np.array(deviations), places
