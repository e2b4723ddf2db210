"""The pixels of a lamp in a photo or in a part of it."""

import math
from dataclasses import dataclass

import cv2
import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region

_DARK = 0.02  # quantile of the pixels that counts as dark
_BRIGHT = 0.99  # quantile of the light, with stripes closed, that counts as the lamp's light
_RIM = 0.25  # least light of a lamp's pixel, as a fraction of the lamp's light
_CLOSED_PART = 0.4  # largest gap between two stripes, as a fraction of the picture's columns
_LEAST_PART = 0.3  # least height of a column of the lamp, as a fraction of the highest one
_SMOOTHING = 0.7  # pixels of blur, so that noise does not look like a lamp's light
_RIM_PIXELS = 2  # width of the rim that blur darkens
_MOST_COLUMNS = 512  # size to which a picture is reduced for the search
_MARGIN = 0.25  # margin around a lamp for a finer search, as a fraction of its size
_LEAST_COLUMNS = 16


@dataclass(frozen=True, eq=False, slots=True)
class LampPlace:
    """The pixels of a lamp, in the smallest rectangle around them."""

    region: Region
    pixels: FloatArray  # Shape (rows, columns of the region): fractions of white
    shown: BoolArray  # Shape as ``pixels``: which of them show the lamp

    def part_above(self, least: float) -> float:
        """Return the fraction of the lamp's pixels that are at least so bright."""
        bright = int(np.count_nonzero((self.pixels >= least) & self.shown))
        return bright / max(int(np.count_nonzero(self.shown)), 1)


def find_place(photo: Photo, region: Region) -> LampPlace | None:
    """Find the brightest lamp within a region; None without pixels brighter than the rest.

    Dark stripes are filled along the columns (a closing), so that the lamp is one patch of light.
    """
    while True:
        part = region.crop(photo.samples)
        step = max(1, math.ceil(max(part.shape) / _MOST_COLUMNS))
        small = cv2.resize(part, None, fx=1 / step, fy=1 / step, interpolation=cv2.INTER_AREA)
        mask = _patch(small.astype(np.float32) / photo.white)
        if mask is None:
            return None
        ends = step * np.array(_bounds(mask, 0.0 if step == 1 else _MARGIN))
        most = np.repeat(part.shape, 2)
        inner = Region(*np.minimum(ends, most).tolist()).within(region)
        if step > 1 and inner.columns * inner.rows < 0.5 * region.columns * region.rows:
            region = inner  # small beside its surroundings: searched again, more finely
            continue
        if step > 1:
            mask = cv2.resize(
                mask.astype(np.uint8), part.shape[::-1], interpolation=cv2.INTER_NEAREST
            ).astype(bool)
        return _crop_lamp(part, mask, region, photo.white)


def _bounds(mask: BoolArray, margin: float) -> tuple[int, int, int, int]:
    """Return the first and end row and column of a mask, with a margin around it."""
    found: list[int] = []
    for axis, count in ((1, mask.shape[0]), (0, mask.shape[1])):
        places = np.flatnonzero(mask.any(axis=axis))
        first, last = int(places[0]), int(places[-1]) + 1
        around = math.ceil(margin * (last - first))
        found += [max(first - around, 0), min(last + around, count)]
    return found[0], found[1], found[2], found[3]


def _crop_lamp(part: FloatArray, mask: BoolArray, region: Region, white: int) -> LampPlace | None:
    """Return the pixels of a mask without its rim; a picture's border is no rim."""
    kernel = np.ones((2 * _RIM_PIXELS + 1,) * 2, dtype=np.uint8)
    inner = cv2.erode(_hull(mask), kernel).astype(bool)
    counts = inner.sum(axis=0)
    shown = np.flatnonzero(counts > _LEAST_PART * counts.max(initial=0))
    if len(shown) < _LEAST_COLUMNS:
        return None
    inner[:, : shown[0]] = inner[:, shown[-1] + 1 :] = False
    place = Region(*_bounds(inner, 0.0))
    pixels = place.crop(part).astype(np.float32) / white
    return LampPlace(place.within(region), pixels, place.crop(inner))


def _hull(mask: BoolArray) -> ByteArray:
    """Return the convex hull of a mask.

    Where a lamp is faint, the mask ends at edges of stripes. Columns on either side of such an edge
    would be means over different rows, which moves the edge outwards.
    """
    rows = np.flatnonzero(mask.any(axis=1))
    first = mask[rows].argmax(axis=1)
    last = mask.shape[1] - 1 - mask[rows, ::-1].argmax(axis=1)
    ends = np.stack([np.concatenate([first, last]), np.concatenate([rows, rows])], axis=1)
    corners = cv2.convexHull(ends.astype(np.int32))
    hull = np.zeros(mask.shape, dtype=np.uint8)
    return np.asarray(cv2.fillConvexPoly(hull, corners, 1), dtype=np.uint8)


def _patch(part: FloatArray) -> BoolArray | None:
    """Return which pixels are the largest patch of light."""
    smooth = cv2.GaussianBlur(part, (0, 0), _SMOOTHING)
    dark = float(np.quantile(part, _DARK))
    reach = int(_CLOSED_PART * part.shape[1]) | 1
    # Dark beside the picture, or the closing would reach from a lamp to its border.
    wide = cv2.copyMakeBorder(
        smooth, 0, 0, reach, reach, cv2.BORDER_CONSTANT, value=(dark, dark, dark, dark)
    )
    kernel = np.ones((1, reach), dtype=np.uint8)
    light = cv2.morphologyEx(wide, cv2.MORPH_CLOSE, kernel)[:, reach:-reach] - dark
    top = float(np.quantile(light, _BRIGHT))
    if top <= 0.0:
        return None
    count, labels, sizes, _ = cv2.connectedComponentsWithStats(
        (light > _RIM * top).astype(np.uint8)
    )
    if count < 2:
        return None
    largest = 1 + int(np.argmax(sizes[1:, cv2.CC_STAT_AREA]))
    return np.asarray(labels == largest)
