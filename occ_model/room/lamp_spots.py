"""Find the lit spots of a picture, and join those of each lamp over its dark columns."""

import math
from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.camera.pixel_arrays import bytes_of
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.results.decoding import Region
from occ_model.room.lamp_frequency import sends_code
from occ_model.room.room import Room, RoomLamp
from occ_model.transmitter.scheme import scheme_of

_MIN_SIGMA_ABOVE_NOISE = 6.0  # above the surroundings, from which a pixel is a lamp's
_MIN_LAMP_FRACTION = 0.1  # fraction of the brightest pixels' light above the surroundings
_SAMPLING_STEP = 4  # step between rows that sample the light of surroundings and lamps
_MIN_SIDE = 12  # rows and columns of the smallest lamp considered
_GAP_STEP = 0.8  # ratio of dark runs up to which their lamps are searched one after the other


def find_spots(image: ByteArray, scale: int, width: int) -> ByteArray:
    """Return where the mean of ``scale`` rows is lit in ``width`` columns: 1, elsewhere 0."""
    rows = len(image) // scale
    sums = image[: rows * scale].reshape(rows, scale, -1).sum(axis=1, dtype=np.uint16)
    some = sums[::_SAMPLING_STEP] / scale
    dark = float(np.median(some))
    noise = 1.48 * float(np.median(np.abs(some - dark)))
    bright = float(np.percentile(some, 99.9))
    level = dark + max(_MIN_SIGMA_ABOVE_NOISE * noise, _MIN_LAMP_FRACTION * (bright - dark), 2.0)
    lit = (sums > level * scale).astype(np.uint8)
    return bytes_of(cv2.morphologyEx(lit, cv2.MORPH_OPEN, np.ones((2, width), np.uint8)))


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
    times = {lamp.name: _longest_dark(lamp) for lamp in room.lamps}
    coded = [lamp.name for lamp in room.lamps if sends_code(lamp)]
    times.update(dict.fromkeys(coded, max((times[name] for name in coded), default=0.0)))
    readout, step = room.scene.camera.readout_time, 0
    gaps = {}
    for name, time in sorted(times.items(), key=lambda each: -each[1]):
        gap = int(time / readout * 1.1) // 2 * 2 + 5
        step = gap if gap < _GAP_STEP * step or not step else step
        gaps[name] = step
    return gaps


def _longest_dark(lamp: RoomLamp) -> float:
    """Return the longest time in seconds for which a lamp, or another such lamp, is dark."""
    light = light_of(lamp.transmitter)
    if isinstance(light, Cosine):
        swing = 1.0 - _MIN_LAMP_FRACTION * (1.0 + light.depth)  # from the mean down to dark
        if swing >= light.depth:
            return 0.0
        return math.acos(swing / light.depth) / (math.pi * light.frequency)
    levels, lengths = (np.tile(own, 2) for own in (light.waveform.levels, light.waveform.lengths))
    lit = np.flatnonzero(levels > _MIN_LAMP_FRACTION * levels.max())
    if len(lit) in (0, len(levels)):
        return 0.0
    starts = np.concatenate([[0], np.cumsum(lengths)])
    run = max(starts[lit[1:]] - starts[lit[:-1] + 1])
    if sends_code(lamp):  # the code of a lamp that is not in the room may have a longer run
        run = max(run, scheme_of(lamp.transmitter).line_code.longest_run or 0)
    return float(run) / float(light.rate)
