"""Find the lamps of a room in a picture, and name each by its code or its frequency."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.pixel_arrays import bytes_of
from occ_model.errors import DecodeInputError
from occ_model.receiver.decode import decode
from occ_model.results.decoding import Region
from occ_model.room.lamp_frequency import MeasuredFrequency, measure_frequency
from occ_model.room.lamp_spots import find_spots, join_spots, longest_gaps
from occ_model.room.room import Room, RoomLamp
from occ_model.scene.light_words import has_chips
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import code_of, packet

_MIN_LIT_FRACTION = 0.5
"""Fraction of a lamp's brightest light from which one of its columns counts as lit."""

_DECODER_SETTINGS = (  # what a decoder must know about a lamp besides its code
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
        Whether it reaches the picture's edge, or may reach it where its light is dark.
    note
        Why it has no name, or that it is cut; otherwise empty.
    frequency
        The frequency of its light, measured if lamps of the room send no code; else None.
    """

    name: str | None
    code: int | None
    region: Region
    hull: FloatArray
    is_cut: bool
    note: str
    frequency: MeasuredFrequency | None = None

    @property
    def light_words(self) -> str:
        """The lamp's code or frequency in words."""
        if self.code is not None:
            return f"code {self.code}"
        return "no code" if self.frequency is None else self.frequency.words


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
    # Fast light that sends no code may be lit in single columns.
    width = 2 if all(has_chips(lamp.transmitter) for lamp in room.lamps) else 1
    (spots, scale), lamps = find_spots(image, width), list[ReadLamp]()
    gaps = longest_gaps(room)
    for gap in sorted({*gaps.values()}):
        for region, hull, pixels in join_spots(spots, gap, scale, len(image)):
            lamp, names = _read_lamp(image, region, hull, room, scale)
            is_whole = max((gaps[name] for name in names), default=0) == gap
            if is_whole or gap == max(gaps.values()):
                spots[pixels] = 0
                lamps.append(lamp if is_whole or not lamp.name else replace(
                    lamp, name=None, note=f"It has longer dark gaps than {lamp.name}.",
                ))  # fmt: skip
    lamps.sort(key=lambda lamp: -lamp.region.rows * lamp.region.columns)
    names = [lamp.name for lamp in lamps if lamp.name]
    return tuple(
        replace(lamp, name=None, note=f"{lamp.name} was read at {names.count(lamp.name)} places.")
        if lamp.name and names.count(lamp.name) > 1
        else lamp
        for lamp in lamps
    )


def settings_of(lamp: RoomLamp) -> tuple[Any, ...]:
    """Return what a decoder must know about a lamp besides its code."""
    return tuple(getattr(lamp.transmitter, name) for name in _DECODER_SETTINGS)


def code_sent(lamp: RoomLamp) -> int:
    """Return the code that a decoder reads from a lamp, or its payload's bits as a number."""
    return code_of(lamp.transmitter.payload_bits)


def _signal(image: ByteArray, region: Region, hull: FloatArray) -> FloatArray:
    """Return the mean pixel value within the outline in each column of the region."""
    part = region.crop(image)
    outline = hull - [region.first_column, region.first_row]
    first, last = column_spans(outline, *part.shape)
    edge = np.minimum(3, (last - first) // 4)
    first, last = first + edge, last - edge
    sums = np.zeros((part.shape[0] + 1, part.shape[1]))
    np.cumsum(part, axis=0, out=sums[1:])
    column = np.arange(part.shape[1])
    total = sums[last, column] - sums[first, column]
    is_visible = last > first
    means = total / np.maximum(last - first, 1)
    return np.asarray(np.interp(column, column[is_visible], means[is_visible]))


def _full_columns(region: Region, hull: FloatArray, shape: tuple[int, ...]) -> slice:
    """Return the columns of a region that show at least half of the lamp's height."""
    first, last = column_spans(hull, *shape)
    height = (last - first)[region.first_column : region.last_column]
    full_columns = np.flatnonzero(height >= height.max() / 2)
    # The outermost columns are only partly lit.
    return slice(int(full_columns[0]) + 1, int(full_columns[-1]))


@dataclass(frozen=True, eq=False, slots=True)
class _Light:
    """The code or the frequency that was read, and the lamps that have it."""

    code: int | None
    names: list[str]
    lit: FloatArray | None  # Light of the lamp in each of the picture's columns, if it is as wide


def _read_lamp(
    image: ByteArray, region: Region, hull: FloatArray, room: Room, edge: int
) -> tuple[ReadLamp, list[str]]:
    """Read a lamp and its possible names; it is cut within ``edge`` rows of the picture's edge."""
    rows, columns = image.shape
    is_cut = (
        region.first_row <= edge or region.first_column <= 1
        or region.last_row >= rows - edge or region.last_column >= columns - 1
    )  # fmt: skip
    signal = _signal(image, region, hull)
    lamp_rows = image[region.first_row : region.last_row]
    bright = lamp_rows.max(axis=0) > _MIN_LIT_FRACTION * signal.max()
    lights, problem = _read_codes(signal, region, room)
    code = lights[0].code if lights else None
    measured = None
    if not all(has_chips(lamp.transmitter) for lamp in room.lamps):
        inner = _full_columns(region, hull, image.shape)
        frequency = measure_frequency(signal[inner], room.scene.camera.readout_time)
        if isinstance(frequency, MeasuredFrequency):
            measured = frequency
            lights.append(_light_of_frequency(signal, region, frequency, room))
            problem = f"No lamp of the room has the frequency {frequency.words}."
        else:
            problem = f"{problem} No frequency was measured: {frequency}".strip()
    cut_note = "It is cut by the picture's edge." if is_cut else ""
    if not is_cut and any(_may_reach_sides(light.lit, region, bright) for light in lights):
        is_cut, cut_note = True, "The picture's edge may cut it: its light is dark there."
    codes = [(name, light.code) for light in lights for name in light.names]
    possible_names = [name for name, _ in codes]
    name = None
    if len(possible_names) == 1:
        ((name, code),), problem = codes, ""
    elif possible_names:
        problem = f"{' and '.join(possible_names)} would look the same."
    note = f"{problem} {cut_note}".strip()
    return ReadLamp(name, code, region, hull, is_cut, note, measured), possible_names


def _read_codes(signal: FloatArray, region: Region, room: Room) -> tuple[list[_Light], str]:
    """Return the codes read with the settings of the room's lamps, and why no lamp is named."""
    lights, failure = [], ""
    with_code = [lamp for lamp in room.lamps if has_chips(lamp.transmitter)]
    for settings in dict.fromkeys(map(settings_of, with_code)):
        named = dict(zip(_DECODER_SETTINGS, settings, strict=True))
        scene = room.scene.replace(**named, light="code", code=0)
        result = decode(signal, scene, "matched")
        if result.code is None:
            failure = failure or f"No code was read: {result.failure}"
            continue
        names = [
            lamp.name for lamp in with_code
            if settings_of(lamp) == settings and code_sent(lamp) == result.code
        ]  # fmt: skip
        lit = None if result.model is None else _expected_light(result.model, scene, region)
        lights.append(_Light(result.code, names, lit))
    return lights, f"No lamp of the room has the code {lights[0].code}." if lights else failure


def _light_of_frequency(
    signal: FloatArray, region: Region, frequency: MeasuredFrequency, room: Room
) -> _Light:
    camera = room.scene.camera
    names = [
        lamp.name for lamp in room.lamps
        if not has_chips(lamp.transmitter) and frequency.is_of(lamp, camera.readout_time)
    ]  # fmt: skip
    column = (np.arange(camera.columns) - region.first_column) % frequency.period
    return _Light(None, names, np.interp(column, np.arange(len(signal)), signal))


def _expected_light(model: FloatArray, scene: Scene, region: Region) -> FloatArray:
    """Return the light of a code that was read in all of the picture's columns."""
    camera, transmitter = scene.camera, scene.transmitter
    column = np.arange(camera.columns) - region.first_column  # columns of the signal that was read
    chip = (scene.model.start_time + column * camera.readout_time) * transmitter.switching_frequency
    bins = len(model)
    position = chip * (bins / len(packet(scene)))
    return np.asarray(np.interp(position, np.arange(bins), model, period=bins))


def _may_reach_sides(lit: FloatArray | None, region: Region, bright: BoolArray) -> bool:
    """Return whether the lamp may reach a side, as it would be dark in all columns up to it."""
    if lit is None:
        return False
    is_missing = (lit > _MIN_LIT_FRACTION * lit.max()) & ~bright
    sides = is_missing[: region.first_column], is_missing[region.last_column :]
    return any(not side.any() for side in sides)
