"""Find the lamps of a room in a picture, decode each, and name it by its code."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.pixel_arrays import bytes_of
from occ_model.errors import DecodeInputError
from occ_model.receiver.decode import decode
from occ_model.results.decoding import DecodeResult, Region
from occ_model.room.room import Room, RoomLamp
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import code_of, packet, scheme_of, sent_chips

_ROWS = 4  # rows that are averaged to search for lamps

_MIN_SIGMA_ABOVE_NOISE = 6.0  # above the surroundings, from which a pixel is a lamp's
_MIN_LAMP_FRACTION = 0.1  # fraction of the brightest pixels' light above the surroundings
_SAMPLING_STEP = 4  # step between rows that sample the light of surroundings and lamps
_MIN_SIDE = 12  # rows and columns of the smallest lamp considered

_MIN_LIT_FRACTION = 0.5
"""Fraction of a lamp's own brightest light from which one of its columns counts as lit."""

_SENT = (  # what a decoder must know about a lamp besides its code
    "switching_frequency", "bits", "payload", "line_code", "framing", "preamble",
    "error_correction", "pattern",
)  # fmt: skip


@dataclass(frozen=True, eq=False, slots=True)
class ReadLamp:
    """A lamp found in a picture.

    Parameters
    ----------
    name
        Its name in the room; None if it has none.
    code
        The code that was read; None if none was.
    region
        The bounding rectangle of its lit pixels.
    hull : ndarray of float64, shape (corners, 2)
        The convex outline of its lit pixels, with (column, row) of each corner.
    is_cut
        Whether it reaches the picture's edge, or may do so where its chips are dark.
    note
        Why it has no name, or that it is cut; otherwise empty.
    """

    name: str | None
    code: int | None
    region: Region
    hull: FloatArray
    is_cut: bool
    note: str


def check_picture(image: NDArray[Any], room: Room) -> ByteArray:
    camera = room.scene.camera
    picture = np.asarray(image)
    if picture.shape != (camera.rows, camera.columns):
        raise DecodeInputError(
            f"A picture of this room has {camera.rows} rows and {camera.columns} columns, not the "
            f"shape {picture.shape}."
        )
    return bytes_of(picture)


def read_lamps(image: ByteArray, room: Room) -> tuple[ReadLamp, ...]:
    """Find the lamps in the camera's picture and name them, the largest first."""
    found = sorted(_find_lamps(image, room), key=lambda one: -one[0].rows * one[0].columns)
    lamps = [_read_lamp(image, region, hull, room) for region, hull in found]
    names = [lamp.name for lamp in lamps if lamp.name]
    return tuple(
        replace(lamp, name=None, note=f"{lamp.name} was read at {names.count(lamp.name)} places.")
        if lamp.name and names.count(lamp.name) > 1
        else lamp
        for lamp in lamps
    )


def _find_lamps(image: ByteArray, room: Room) -> Iterator[tuple[Region, FloatArray]]:
    """Return the region and the convex outline of each group of lit pixels."""
    scale = min(_ROWS, len(image))
    rows = len(image) // scale
    sums = image[: rows * scale].reshape(rows, scale, -1).sum(axis=1, dtype=np.uint16)
    some = sums[::_SAMPLING_STEP] / scale
    dark = float(np.median(some))
    noise = 1.48 * float(np.median(np.abs(some - dark)))
    bright = float(np.percentile(some, 99.9))
    level = dark + max(_MIN_SIGMA_ABOVE_NOISE * noise, _MIN_LAMP_FRACTION * (bright - dark), 2.0)
    lit = (sums > level * scale).astype(np.uint8)
    spots = cv2.morphologyEx(lit, cv2.MORPH_OPEN, np.ones((2, 2), np.uint8))
    joined = cv2.morphologyEx(spots, cv2.MORPH_CLOSE, np.ones((1, _longest_gap(room)), np.uint8))
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
        first, last = y * scale, min(len(image), (y + height) * scale + 1)
        # Closing extends spots near the picture's sides up to them, so the lit pixels count.
        left, right = int(hull[:, 0].min()), int(hull[:, 0].max()) + 1
        yield Region(first, last, left, right), hull


def _ends_of_rows(lit: BoolArray) -> NDArray[np.int32]:
    """Return the first and the last lit pixel of each row, whose hull contains the others."""
    rows = np.flatnonzero(lit.any(axis=1))
    first = lit[rows].argmax(axis=1)
    last = lit.shape[1] - 1 - lit[rows, ::-1].argmax(axis=1)
    ends = np.stack([np.concatenate([first, last]), np.concatenate([rows, rows])], axis=1)
    return ends.astype(np.int32)


def _longest_gap(room: Room) -> int:
    """Return the columns of the longest dark run of any lamp, as an odd number."""
    longest = 0.0
    for lamp in room.lamps:
        chips = sent_chips(lamp.transmitter)
        if chips.all() or not chips.any():
            continue
        ends = np.flatnonzero(np.concatenate([chips, chips]))
        gap = int(np.diff(ends).max()) - 1
        # The code of a lamp that is not in the room may have a longer run.
        run = max(gap, scheme_of(lamp.transmitter).line_code.longest_run or 0)
        longest = max(longest, run / lamp.transmitter.switching_frequency)
    return int(longest / room.scene.camera.readout_time * 1.1) // 2 * 2 + 5


def _settings(room: Room) -> tuple[Scene, ...]:
    """Return a scene for each combination of settings with which lamps of the room send."""
    return tuple(
        room.scene.replace(**dict(zip(_SENT, sent, strict=True)), code=0)
        for sent in dict.fromkeys(settings_of(lamp) for lamp in room.lamps)
    )


def settings_of(lamp: RoomLamp) -> tuple[Any, ...]:
    """Return what a decoder must know about a lamp besides its code."""
    return tuple(getattr(lamp.transmitter, name) for name in _SENT)


def code_sent(lamp: RoomLamp) -> int:
    """Return the code that a decoder reads from a lamp, or its payload's bits as a number."""
    return code_of(lamp.transmitter.payload_bits)


def _signal(image: ByteArray, region: Region, hull: FloatArray) -> FloatArray:
    """Return the mean pixel value within the outline in each column of the region."""
    part = region.crop(image)
    own = hull - [region.first_column, region.first_row]
    first, last = column_spans(own, *part.shape)
    edge = np.minimum(3, (last - first) // 4)
    first, last = first + edge, last - edge
    sums = np.zeros((part.shape[0] + 1, part.shape[1]))
    np.cumsum(part, axis=0, out=sums[1:])
    column = np.arange(part.shape[1])
    total = sums[last, column] - sums[first, column]
    shown = last > first
    means = total / np.maximum(last - first, 1)
    return np.asarray(np.interp(column, column[shown], means[shown]))


def _read_lamp(image: ByteArray, region: Region, hull: FloatArray, room: Room) -> ReadLamp:
    rows, columns = image.shape
    is_cut = (
        region.first_row <= _ROWS or region.first_column <= 1
        or region.last_row >= rows - _ROWS or region.last_column >= columns - 1
    )  # fmt: skip
    signal = _signal(image, region, hull)
    codes: list[tuple[int, list[str]]] = []
    failure, hides = "", False
    own_rows = image[region.first_row : region.last_row]
    bright = own_rows.max(axis=0) > _MIN_LIT_FRACTION * signal.max()
    for scene in _settings(room):
        result = decode(signal, scene, "matched")
        if result.code is None:
            failure = failure or str(result.failure)
            continue
        sent = tuple(getattr(scene.transmitter, name) for name in _SENT)
        names = [
            lamp.name for lamp in room.lamps
            if settings_of(lamp) == sent and code_sent(lamp) == result.code
        ]  # fmt: skip
        codes.append((result.code, names))
        hides = hides or _may_reach_sides(result, scene, region, bright)
    known = [(code, name) for code, names in codes for name in names]
    code = codes[0][0] if codes else None
    cut = "It is cut by the picture's edge." if is_cut else ""
    if hides and not is_cut:
        is_cut, cut = True, "The picture's edge may cut it: its chips are dark there."
    if len(known) == 1:
        return ReadLamp(known[0][1], known[0][0], region, hull, is_cut, cut)
    if known:
        why = f"{' and '.join(name for _, name in known)} would look the same."
    elif codes:
        why = f"No lamp of the room has the code {code}."
    else:
        why = f"No code was read: {failure}"
    return ReadLamp(None, code, region, hull, is_cut, f"{why} {cut}".strip())


def _may_reach_sides(result: DecodeResult, scene: Scene, region: Region, bright: BoolArray) -> bool:
    """Return whether the lamp may reach a side, all columns up to it being dark by its chips."""
    if result.model is None:
        return False
    camera, sent = scene.camera, scene.transmitter
    column = np.arange(camera.columns) - region.first_column  # columns of the signal that was read
    chip = (scene.model.start_time + column * camera.readout_time) * sent.switching_frequency
    bins = len(result.model)
    place = chip * (bins / len(packet(scene)))
    lit = np.interp(place, np.arange(bins), result.model, period=bins)
    lacking = (lit > _MIN_LIT_FRACTION * result.model.max()) & ~bright
    sides = lacking[: region.first_column], lacking[region.last_column :]
    return any(not side.any() for side in sides)
