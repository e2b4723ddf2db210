"""Read the chips from stripes of which only the period is known.

Stripes that repeat after T columns are a sum of harmonics of 1/T. P chips per period have only P
unknown levels; the exposure and the length of a chip multiply the harmonics by those of boxes. For
each P and exposure the chips that explain the harmonics best therefore follow by division. They are
rounded to on and off, and the shortest period whose rounded chips explain the stripes is taken.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.stripes.envelope import without_trend

MOST_CHIPS = 128
"""Largest number of chips in a period."""

_LEAST_COLUMNS = 2.0
"""Smallest number of columns per chip."""

_EXPOSURES = (0.1, 0.5, 0.9, 1.3, 1.7, 2.3, 2.7, 3.3)
_PHASES = 8
"""Number of phases within a chip that are tried."""

_NOISE = 0.01
"""Share of the largest weight below which a harmonic is dominated by noise."""

_MOST_HARMONICS = 160

_COHERENT = 0.93
"""Coherence of the edges with a lattice of chips, as a share of the most coherent lattice's.

Below 1, since gamma makes bright runs longer than dark ones. Therefore a single pulse of 1/8 of a
period cannot be distinguished from one of 1/9.
"""

_LEAST_COHERENCE = 0.6

_LEAST_CROSSINGS = 4

_UNEXPLAINED = 0.15
"""Largest share of the harmonics' power that the right chips leave unexplained."""

_DIP = 0.5
"""Ratio to neighbouring numbers of chips of the power that the right one leaves unexplained."""

_BESIDE = (-3, -2, -1, 1, 2, 3)


@dataclass(frozen=True, eq=False, slots=True)
class ReadPattern:
    """Chips read from stripes.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        One period.
    explained
        Correlation of their harmonics with those in the photo.
    """

    chips: ByteArray
    explained: float


def read_pattern(profile: FloatArray, flattened: FloatArray, period: float) -> ReadPattern | None:
    """Read the shortest repeating sequence of chips that explains the stripes.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    flattened : ndarray of float64, shape (columns,)
        The profile without uneven light, from 0 (dark) to 1 (bright).
    period
        Columns after which the profile repeats.

    Returns
    -------
    ReadPattern or None
        None where no sequence explains the stripes.

    Notes
    -----
    Chips may be misread, or not be read, where the exposure is shorter than a column's readout: the
    position of an edge within a column is then unknown.
    """
    lines = _harmonics(without_trend(profile), period)
    most = min(MOST_CHIPS, int(period / _LEAST_COLUMNS))
    count = _chips_by_edges(flattened, period, most)
    read = None if count is None else _coarsest(lines, count)
    if read is None:
        read = _chips_by_lines(lines, most)
    return None if read is None else ReadPattern(canonical(read.chips), read.explained)


def _coarsest(lines: NDArray[np.complex128], count: int) -> ReadPattern | None:
    """Find chips that explain the harmonics, their number being a divisor of a given one.

    An exposure of nearly a chip shifts edges off the lattice of the chips, onto a finer one.
    """
    for divisor in range(2, count + 1):
        if count % divisor == 0:
            read = _best_chips(lines, divisor)
            if read is not None and _unexplained(read) <= _UNEXPLAINED:
                return read
    return None


def _chips_by_edges(flattened: FloatArray, period: float, most: int) -> int | None:
    """Count the chips of a period by the coarsest lattice that all edges lie on."""
    above = flattened > 0.5
    before = np.flatnonzero(above[1:] != above[:-1])
    if before.size < _LEAST_CROSSINGS:
        return None
    low, high = flattened[before], flattened[before + 1]
    edges = before + (0.5 - low) / (high - low)
    count = np.arange(2, most + 1)
    turns = np.exp(2j * np.pi / period * np.outer(count, edges))
    coherence = np.abs(turns.mean(axis=1))
    if coherence.size == 0 or coherence.max() < _LEAST_COHERENCE:
        return None
    return int(count[np.flatnonzero(coherence >= _COHERENT * coherence.max())[0]])


def _chips_by_lines(lines: NDArray[np.complex128], most: int) -> ReadPattern | None:
    """Find the smallest number of chips that explains the harmonics far better than its neighbours.

    This method needs no edges: an exposure of several chips leaves none.
    """
    read = {count: _best_chips(lines, count) for count in range(2, most + 1)}
    left = {count: 1.0 if one is None else _unexplained(one) for count, one in read.items()}
    for count, one in read.items():
        beside = [left[count + step] for step in _BESIDE if count + step in left]
        stands_out = bool(beside) and left[count] <= _DIP * float(np.median(beside))
        if left[count] <= _UNEXPLAINED and stands_out:
            return one
    return None


def _unexplained(read: ReadPattern) -> float:
    return 1.0 - max(read.explained, 0.0) ** 2


def canonical(chips: ByteArray) -> ByteArray:
    """Rotate a sequence so that its longest run of ones comes first, and keep one period of it."""
    text = "".join(map(str, chips.tolist()))
    shortest = (text + text).find(text, 1)
    text = text[:shortest]
    turned = max(text[start:] + text[:start] for start in range(len(text)))
    return np.array(list(turned), dtype=np.uint8)


def _harmonics(even: FloatArray, period: float) -> NDArray[np.complex128]:
    """Give the strength of each harmonic of 1/period, from the first."""
    columns = len(even)
    count = int(np.clip(period / 2.0, 2, _MOST_HARMONICS))
    # Over whole periods, since otherwise the harmonics leak into each other.
    whole = int(int(columns / period) * period) or columns
    turn = np.exp(-2j * np.pi / period * np.outer(np.arange(1, count + 1), np.arange(whole)))
    return np.asarray(turn @ even[:whole] / whole)


def _best_chips(lines: NDArray[np.complex128], count: int) -> ReadPattern | None:
    """Find the chips, over all exposures and phases, whose harmonics are most like those given."""
    order = np.arange(1, len(lines) + 1)
    best: ReadPattern | None = None
    for exposure in _EXPOSURES:
        weight = np.sinc(order / count) * np.sinc(order * exposure / count) / count
        for phase in range(_PHASES):
            turned = weight * np.exp(-2j * np.pi * order * phase / (_PHASES * count))
            chips = _rounded(_levels(lines, turned, count))
            if chips is None:
                continue
            model = np.fft.fft(chips)[order % count] * turned
            explained = _likeness(lines, model)
            if best is None or explained > best.explained:
                best = ReadPattern(chips, explained)
    return best


def _levels(
    lines: NDArray[np.complex128], weight: NDArray[np.complex128], count: int
) -> FloatArray:
    """Solve for the chips' levels: harmonics that are equal modulo their number give one."""
    order = np.arange(1, len(lines) + 1) % count
    power = np.bincount(order, np.abs(weight) ** 2, count)
    products = lines * np.conj(weight)
    real = np.bincount(order, products.real, count)
    sums = real + 1j * np.bincount(order, products.imag, count)
    spectrum = sums / (power + _NOISE * power.max())
    # The spectrum of real levels is its own mirror image, conjugated.
    spectrum[0] = 0.0
    mirrored = np.conj(spectrum[(-np.arange(count)) % count])
    both = (power + power[(-np.arange(count)) % count]) > 0.0
    own = np.where(power >= power[(-np.arange(count)) % count], spectrum, mirrored)
    return np.asarray(np.fft.ifft(np.where(both, own, 0.0)).real)


def _rounded(levels: FloatArray) -> ByteArray | None:
    """Round levels to off and on, half-way between the means of either kind."""
    split = 0.5 * (levels.max() + levels.min())
    for _ in range(8):
        on = levels > split
        if on.all() or not on.any():
            return None
        split = 0.5 * (levels[on].mean() + levels[~on].mean())
    return np.asarray(levels > split, dtype=np.uint8)


def _likeness(a: NDArray[np.complex128], b: NDArray[np.complex128]) -> float:
    energy = float(np.sqrt((np.abs(a) ** 2).sum() * (np.abs(b) ** 2).sum()))
    return float((a * np.conj(b)).real.sum()) / energy if energy > 0.0 else 0.0
