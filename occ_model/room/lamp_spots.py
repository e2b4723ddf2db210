"""Find the lit spots of a picture, and join those of each lamp over its dark columns."""

from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.camera.exposure import lit_fraction
from occ_model.camera.pixel_arrays import bytes_of
from occ_model.results.decoding import Region
from occ_model.room.lamp_frequency import sends_code
from occ_model.room.room import Room, RoomLamp
from occ_model.room.view import scene_with_lamp
from occ_model.transmitter.scheme import scheme_of, sent_chips

_ROWS = 4  # rows that are averaged at least
_MOST_ROWS = 32
_MOST_NOISE = 0.5  # fraction of the lamps' light up to which the noise's limit may be
_MIN_SIGMA_ABOVE_NOISE = 6.0  # above the surroundings, from which a pixel is a lamp's
_MIN_LAMP_FRACTION = 0.1  # fraction of the brightest pixels' light above the surroundings
_SAMPLING_STEP = 4  # step between rows that sample the light of surroundings and lamps
_MIN_SIDE = 12  # rows and columns of the smallest lamp considered
_GAP_STEP = 0.8  # ratio of dark runs up to which their lamps are searched one after the other


def find_spots(image: ByteArray, width: int) -> tuple[ByteArray, int]:
    """Return where ``width`` columns are lit, 1, or not, 0, in the mean of some rows; and these.

    The dimmer the picture's lamps are, the more rows are averaged.
    """
    scale = min(_ROWS, len(image))
    while True:
        rows = len(image) // scale
        sums = image[: rows * scale].reshape(rows, scale, -1).sum(axis=1, dtype=np.uint16)
        some = sums[::_SAMPLING_STEP] / scale
        dark = float(np.median(some))
        noise = _MIN_SIGMA_ABOVE_NOISE * 1.48 * float(np.median(np.abs(some - dark)))
        light = float(np.percentile(some, 99.9)) - dark
        if noise <= _MOST_NOISE * light or scale >= min(_MOST_ROWS, len(image) // _MIN_SIDE):
            break
        scale *= 2
    level = dark + max(noise, _MIN_LAMP_FRACTION * light, 2.0)
    lit = (sums > level * scale).astype(np.uint8)
    return bytes_of(cv2.morphologyEx(lit, cv2.MORPH_OPEN, np.ones((2, width), np.uint8))), scale


def join_spots(
    spots: ByteArray, gap: int, scale: int, rows: int
) -> Iterator[tuple[Region, FloatArray, tuple[IndexArray, ...]]]:
    """Return the region, the convex outline and the places of spots joined over dark columns."""
    joined = cv2.morphologyEx(spots, cv2.MORPH_CLOSE, np.ones((1, gap), np.uint8))
    count, labels, stats, _ = cv2.connectedComponentsWithStats(joined, connectivity=8)
    for label in range(1, count):
        x, y, width, height, _ = stats[label].tolist()
        if width < _MIN_SIDE or height * scale < _MIN_SIDE:
            continue
        part = np.s_[y : y + height, x : x + width]
        own = (labels[part] == label) & (spots[part] > 0)
        corners = cv2.convexHull(_ends_of_rows(own)).reshape(-1, 2)
        hull = corners.astype(np.float64) + np.array([x, y])
        hull[:, 1] = (hull[:, 1] + 0.5) * scale - 0.5
        first, last = y * scale, min(rows, (y + height) * scale + 1)
        # Closing extends spots near the picture's sides up to them, so the lit pixels count.
        left, right = int(hull[:, 0].min()), int(hull[:, 0].max()) + 1
        row, column = np.nonzero(own)
        yield Region(first, last, left, right), hull, (row + y, column + x)


def _ends_of_rows(lit: BoolArray) -> NDArray[np.int32]:
    """Return the first and the last lit pixel of each row, whose hull contains the others."""
    rows = np.flatnonzero(lit.any(axis=1))
    first = lit[rows].argmax(axis=1)
    last = lit.shape[1] - 1 - lit[rows, ::-1].argmax(axis=1)
    ends = np.stack([np.concatenate([first, last]), np.concatenate([rows, rows])], axis=1)
    return ends.astype(np.int32)


def longest_gaps(room: Room) -> dict[str, int]:
    """Return the columns, made odd, over which spots are to be joined for each of a room's lamps.

    It is the longest dark run of the lamp, of any lamp with a code, or of one that is about as
    dark.
    """
    runs = {lamp.name: _longest_dark(room, lamp) for lamp in room.lamps}
    coded = [lamp.name for lamp in room.lamps if sends_code(lamp)]
    runs.update(dict.fromkeys(coded, max((runs[name] for name in coded), default=0.0)))
    gaps, step = {}, 0
    for name, run in sorted(runs.items(), key=lambda each: -each[1]):
        gap = int(run * 1.1) // 2 * 2 + 5
        step = gap if gap < _GAP_STEP * step or not step else step
        gaps[name] = step
    return gaps


def _longest_dark(room: Room, lamp: RoomLamp) -> float:
    """Return the most columns for which a lamp, or another such lamp, is dark."""
    if not sends_code(lamp):
        # Columns can miss short flashes, so that they are dark for more than one period.
        light = lit_fraction(scene_with_lamp(room, lamp))
        lit = np.flatnonzero(light > _MOST_NOISE * light.max())
        return float(np.diff(lit).max(initial=1)) - 1.0
    chips = sent_chips(lamp.transmitter)
    if chips.all() or not chips.any():
        return 0.0
    gap = int(np.diff(np.flatnonzero(np.concatenate([chips, chips]))).max()) - 1
    # The code of a lamp that is not in the room may have a longer run.
    run = max(gap, scheme_of(lamp.transmitter).line_code.longest_run or 0)
    return run / lamp.transmitter.switching_frequency / room.scene.camera.readout_time
