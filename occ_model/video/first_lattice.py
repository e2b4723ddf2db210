"""The chips that a decoder found, on a regular lattice: the start of the fit of their timing."""

from dataclasses import replace

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.video.chip_timing import ChipLattice

_MIN_EDGES = 4  # fewest edges between chips that show a lattice
_MAX_EDGE_ERROR = 0.3  # chips off the lattice from which an edge shows that chips were miscounted

_SEARCHED_FRACTION = 0.05  # of the expected length of a chip, within which another is searched
_STEPS_A_TURN = 8.0  # lengths of a chip tried while the last edge moves by a chip against the first


def first_lattice(
    result: DecodeResult, signal: FloatArray, before: int, scene: Scene
) -> ChipLattice | None:
    """Put the chips of a decoder on a regular lattice; None where it found none.

    ``before``: how many columns of the signal lie before the result's region. The scene's exposure
    time and switching frequency are a first guess.
    """
    starts = result.chip_starts
    if starts is None or result.chips.size < _MIN_EDGES:
        return None
    starts = starts + before
    exposure = scene.camera.exposure_time * scene.transmitter.switching_frequency
    edges = np.flatnonzero(np.diff(result.chips.astype(np.int64))) + 1
    if len(edges) < _MIN_EDGES:
        return None
    places, numbers = starts[edges], edges.astype(np.float64)
    rising = result.chips[edges] == 1
    step, offsets = _regular(places, numbers, rising)
    if step <= 0.0 or np.abs(offsets).max() > _MAX_EDGE_ERROR:
        expected = scene.camera.readout_time * scene.transmitter.switching_frequency
        step = _most_coherent(places, rising, expected)
        numbers = _numbered(places, rising, step)
    # The middle of an exposure at a column is where its chip is read.
    middle = float(np.mean(numbers - places * step))
    phase = middle - 0.5 * exposure
    lattice = _regular_chips(len(signal), step, phase, exposure)
    numbers = lattice.first + np.arange(len(lattice.values), dtype=np.float64)
    middles = np.asarray((numbers + 0.5 - middle) / step, dtype=np.float64)
    return replace(lattice, values=_values(result, starts, signal, middles))


def _regular(
    places: FloatArray, numbers: FloatArray, rising: BoolArray
) -> tuple[float, FloatArray]:
    """Return the chips a column of a line through edges, and how far each edge lies off it."""
    parts = np.column_stack([np.ones(len(places)), numbers, np.where(rising, 0.5, -0.5)])
    found = np.linalg.lstsq(parts, places, rcond=None)[0]
    if found[1] <= 0.0:
        return 0.0, np.zeros(len(places))
    return float(1.0 / found[1]), np.asarray((places - parts @ found) / found[1])


def _most_coherent(places: FloatArray, rising: BoolArray, expected: float) -> float:
    """Return the chips a column, near what is expected, on whose lattice edges lie best."""
    extent = max(float(np.ptp(places)), 1.0)
    reach = max(_SEARCHED_FRACTION * expected, 1.0 / extent)
    count = int(np.ceil(2.0 * reach * extent * _STEPS_A_TURN)) + 1
    steps = expected + np.linspace(-reach, reach, count)
    turns = np.exp(2j * np.pi * np.outer(steps, places))
    coherent = np.abs(turns[:, rising].sum(axis=1)) + np.abs(turns[:, ~rising].sum(axis=1))
    return float(steps[int(np.argmax(coherent))])


def _numbered(places: FloatArray, rising: BoolArray, step: float) -> FloatArray:
    """Count the chips before each edge on a lattice."""
    numbers = places * step
    for kind in (rising, ~rising):
        if kind.any():
            turn = np.angle(np.exp(2j * np.pi * numbers[kind]).sum()) / (2.0 * np.pi)
            numbers[kind] = np.rint(numbers[kind] - turn)
    return np.asarray(numbers)


def _regular_chips(columns: int, step: float, phase: float, exposure: float) -> ChipLattice:
    first = int(np.floor(phase))
    last = max(int(np.ceil(phase + step * (columns - 1) + exposure)), first + 1)
    return ChipLattice(step, phase, exposure, first, np.zeros(last - first, dtype=np.uint8))


def _values(
    result: DecodeResult, starts: FloatArray, signal: FloatArray, middles: FloatArray
) -> ByteArray:
    """Read each chip in the column whose exposure's middle is the chip's."""
    nearest = np.clip(np.rint(middles), 0, len(signal) - 1).astype(np.int64)
    if result.threshold is not None:
        return np.asarray(signal[nearest] > result.threshold, dtype=np.uint8)
    place = np.clip(np.searchsorted(starts, nearest, side="right") - 1, 0, len(starts) - 1)
    return np.asarray(result.chips[place])
