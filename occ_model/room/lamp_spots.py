"""Find the lit spots of a picture, and join the spots of each lamp across its dark columns."""

from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.camera.exposure import lit_fraction
from occ_model.camera.pixel_arrays import bytes_of
from occ_model.results.decoding import Region
from occ_model.room.room import Room, RoomLamp
from occ_model.room.view import scene_with_lamp
from occ_model.scene.light_words import has_chips
from occ_model.transmitter.scheme import scheme_of, sent_chips

_MIN_ROWS = 4  # rows that are averaged
_MAX_ROWS = 32
_MAX_NOISE = 0.5  # maximum of the noise's limit, as a fraction of the lamps' light
_MIN_SIGMA_ABOVE_NOISE = 6.0  # above the surroundings, from which a pixel belongs to a lamp
_MIN_LAMP_FRACTION = 0.1  # fraction of the brightest pixels' light above the surroundings
_SAMPLING_STEP = 4  # step between rows that sample the light of surroundings and lamps
_MIN_SIDE = 12  # rows and columns of the smallest lamp considered
_GAP_STEP = 0.8  # ratio of dark runs below which their lamps are searched separately


def find_spots(image: ByteArray, width: int) -> tuple[ByteArray, int]:
    """Return the spots at least ``width`` columns wide (1: lit, 0: dark), and the rows averaged.

    The dimmer the picture's lamps are, the more rows are averaged for each row of the spots.
    """
    scale = min(_MIN_ROWS, len(image))
    while True:
        rows = len(image) // scale
        sums = image[: rows * scale].reshape(rows, scale, -1).sum(axis=1, dtype=np.uint16)
        sample = sums[::_SAMPLING_STEP] / scale
        dark = float(np.median(sample))
        noise = _MIN_SIGMA_ABOVE_NOISE * 1.48 * float(np.median(np.abs(sample - dark)))
        light = float(np.percentile(sample, 99.9)) - dark
        if noise <= _MAX_NOISE * light or scale >= min(_MAX_ROWS, len(image) // _MIN_SIDE):
            break
        scale *= 2
    level = dark + max(noise, _MIN_LAMP_FRACTION * light, 2.0)
    lit = (sums > level * scale).astype(np.uint8)
    return bytes_of(cv2.morphologyEx(lit, cv2.MORPH_OPEN, np.ones((2, width), np.uint8))), scale


def join_spots(
    spots: ByteArray, gap: int, scale: int, rows: int
) -> Iterator[tuple[Region, FloatArray, tuple[IndexArray, ...]]]:
    """Yield the region, convex outline and pixels of spots that are joined across dark columns."""
    joined = cv2.morphologyEx(spots, cv2.MORPH_CLOSE, np.ones((1, gap), np.uint8))
    count, labels, stats, _ = cv2.connectedComponentsWithStats(joined, connectivity=8)
    for label in range(1, count):
        x, y, width, height, _ = stats[label].tolist()
        if width < _MIN_SIDE or height * scale < _MIN_SIDE:
            continue
        box = np.s_[y : y + height, x : x + width]
        is_lit = (labels[box] == label) & (spots[box] > 0)
        corners = cv2.convexHull(_ends_of_rows(is_lit)).reshape(-1, 2)
        hull = corners.astype(np.float64) + np.array([x, y])
        hull[:, 1] = (hull[:, 1] + 0.5) * scale - 0.5
        first, last = y * scale, min(rows, (y + height) * scale + 1)
        # Closing extends spots near the picture's sides up to them, so only lit pixels count.
        left, right = int(hull[:, 0].min()), int(hull[:, 0].max()) + 1
        row, column = np.nonzero(is_lit)
        yield Region(first, last, left, right), hull, (row + y, column + x)


def _ends_of_rows(lit: BoolArray) -> NDArray[np.int32]:
    """Return the first and the last lit pixel of each row, whose hull contains the others."""
    rows = np.flatnonzero(lit.any(axis=1))
    first = lit[rows].argmax(axis=1)
    last = lit.shape[1] - 1 - lit[rows, ::-1].argmax(axis=1)
    ends = np.stack([np.concatenate([first, last]), np.concatenate([rows, rows])], axis=1)
    return ends.astype(np.int32)


def longest_gaps(room: Room) -> dict[str, int]:
    """Return the odd number of columns across which the spots of each lamp of a room are joined.

    It exceeds the longest dark run of the lamp, of any lamp with a code, and of lamps with runs of
    about the same length.
    """
    runs = {lamp.name: _longest_dark_run(room, lamp) for lamp in room.lamps}
    names_with_code = [lamp.name for lamp in room.lamps if has_chips(lamp.transmitter)]
    runs.update(
        dict.fromkeys(names_with_code, max((runs[name] for name in names_with_code), default=0.0))
    )
    gaps, largest_gap = {}, 0
    for name, run in sorted(runs.items(), key=lambda each: -each[1]):
        gap = int(run * 1.1) // 2 * 2 + 5
        largest_gap = gap if gap < _GAP_STEP * largest_gap or not largest_gap else largest_gap
        gaps[name] = largest_gap
    return gaps


def _longest_dark_run(room: Room, lamp: RoomLamp) -> float:
    """Return the maximum number of columns in which a lamp, or another one like it, is dark."""
    if not has_chips(lamp.transmitter):
        # Columns can miss short flashes, so that they are dark for more than one period.
        light = lit_fraction(scene_with_lamp(room, lamp))
        lit = np.flatnonzero(light > _MAX_NOISE * light.max())
        return float(np.diff(lit).max(initial=1)) - 1.0
    chips = sent_chips(lamp.transmitter)
    if chips.all() or not chips.any():
        return 0.0
    gap = int(np.diff(np.flatnonzero(np.concatenate([chips, chips]))).max()) - 1
    # The code of a lamp that is not in the room may have a longer run.
    run = max(gap, scheme_of(lamp.transmitter).line_code.longest_run or 0)
    return run / lamp.transmitter.switching_frequency / room.scene.camera.readout_time
