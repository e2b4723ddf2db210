"""The chips whose harmonics are most like given ones.

Stripes that repeat after T columns are a sum of harmonics of 1/T. P chips per period have only P
unknown levels; the exposure and the length of a chip multiply the harmonics by those of boxes. For
each P, exposure and phase the chips that explain the harmonics best therefore follow by division,
and are rounded to on and off.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.stripes.envelope import MEAN_SHAPES
from occ_model.photo.stripes.period import Harmonics, repeated_wave
from occ_model.products import row_products

_EXPOSURES = (0.1, 0.5, 0.9, 1.15, 1.3, 1.5, 1.7, 1.85, 2.15, 2.3, 2.5, 2.7, 2.85, 3.3)
_PHASES = np.arange(8) / 8.0  # in chips, as the exposures, that are tried for division
_LEAST_WEIGHT = 0.01  # weight relative to the largest one below which a harmonic is mostly noise

_MOST_HARMONICS = 160

_MOST_EVALUATIONS = 120

_MOST_WIDENING = 0.5  # maximum change, in chips, of bright runs by gamma and saturation

_DENSE_EXPOSURES = (0.5, 0.9, 1.15, 1.3, 1.5, 1.7, 1.85, 2.0, 2.15, 2.3, 2.5, 2.7, 2.85, 3.0, 3.15)
_DENSE_PHASES = np.arange(16) / 16.0
"""Exposures and phases in chips that are tried for a descent."""

_LEAST_GAIN = 1e-9  # increase of the likeness beyond rounding error


@dataclass(frozen=True, eq=False, slots=True)
class ReadPattern:
    chips: ByteArray  # shape (chips,); one period
    explained: float  # correlation of their harmonics with those in the photo
    # exposure, phase: the exposure and the place of the first chip, in chips, with which the
    # harmonics are explained best.
    exposure: float
    phase: float
    times: int = 1  # how many times the chips are sent in a period of the stripes


def harmonics_of(even: FloatArray, period: float) -> Harmonics:
    """Return the strength of each harmonic of 1/period, from the first.

    They are fitted together with a trend, whose removal before has changed the slow harmonics.
    """
    columns = len(even)
    count = int(np.clip(period / 2.0, 2, _MOST_HARMONICS))
    count = min(count, max(2, (columns - MEAN_SHAPES) // 3))
    return repeated_wave(even, period, count, MEAN_SHAPES)[0]


def best_chips(harmonics: Harmonics, count: int) -> ReadPattern | None:
    """Find the chips, over all exposures and phases, whose harmonics are most like those given."""
    order = np.arange(1, len(harmonics) + 1)
    exposures, phases = (part.ravel() for part in np.meshgrid(_EXPOSURES, _PHASES))
    turned = boxes_of(len(harmonics), count, exposures, phases)
    chips = rounded_chips(harmonics, turned, count)
    model = np.fft.fft(chips, axis=1)[:, order % count] * turned
    explained = _likeness(harmonics, model)
    best = int(explained.argmax())
    if chips[best].min() == chips[best].max():
        return None
    found = float(exposures[best]), float(phases[best])
    return ReadPattern(chips[best], float(explained[best]), *found)


def boxes_of(
    number: int, count: int, exposures: FloatArray, phases: FloatArray
) -> NDArray[np.complex128]:
    """Return the boxes of chip and exposure that multiply harmonics, shape (trials, harmonics)."""
    order = np.arange(1, number + 1)
    boxes = np.sinc(order / count) * np.sinc(np.outer(exposures, order / count)) / count
    return np.asarray(boxes * np.exp(-2j * np.pi / count * np.outer(phases, order)), complex)


def rounded_chips(harmonics: Harmonics, boxes: NDArray[np.complex128], count: int) -> ByteArray:
    """Divide harmonics by each row of boxes, and round the chips' levels, shape (trials, chips)."""
    return _round_levels(_levels(harmonics, boxes, count))


def refine_timing(
    harmonics: Harmonics, found: ReadPattern, column: float | None = None
) -> ReadPattern:
    """Refine exposure and phase, and let bright runs be longer or shorter than their chips.

    ``column``: chips a column; None for saturated stripes. Whatever the tone curve, light passes
    half its height within the ramp of each edge, so that bright runs are longer by less than a
    ramp, which lasts the exposure and, by blur, a column. In saturated stripes white hides the
    upper part of the ramps.
    """
    # Imported only when a photo is matched: it is slow.
    from scipy.optimize import minimize

    count, order = len(found.chips), np.arange(1, len(harmonics) + 1)
    turn = -2j * np.pi * order / count
    change = found.chips.astype(np.int64) - np.roll(found.chips, 1)
    rising, falling = (np.fft.fft(kind)[order % count] / -turn for kind in (change > 0, change < 0))

    def unlikeness(values: FloatArray) -> float:
        exposure, phase, longer = values.tolist()
        box = np.sinc(order * exposure / count)
        model = (rising - falling * np.exp(turn * longer)) * box * np.exp(turn * phase)
        return -float(_likeness(harmonics, model[None])[0])

    # A chip's own box is centred half a chip after its rising edge.
    start = [found.exposure, found.phase - 0.5, 0.0]
    steps = np.vstack([start, *(start + 0.1 * np.eye(3))])
    best = minimize(
        unlikeness,
        start,
        method="Nelder-Mead",
        options={
            "initial_simplex": steps,
            "maxfev": _MOST_EVALUATIONS,
            "xatol": 0.01,
            "fatol": 1e-4,
        },
    )
    exposure, phase, longer = best.x.tolist()
    most = _MOST_WIDENING if column is None else min(_MOST_WIDENING, abs(exposure) + column)
    if abs(longer) > most:
        return found
    return ReadPattern(found.chips, -float(best.fun), abs(exposure), phase + 0.5)


def _levels(harmonics: Harmonics, weights: NDArray[np.complex128], count: int) -> FloatArray:
    """Solve for the chips' levels, shape (trials, chips).

    Harmonics that are equal modulo the number of chips give one equation. ``weights``: shape
    (trials, harmonics), what multiplies the chips' own harmonics, for each exposure and phase.
    """

    def fold(values: Harmonics) -> Harmonics:
        missing = -(values.shape[1] + 1) % count
        whole = np.pad(values, ((0, 0), (1, missing)))
        return np.asarray(whole.reshape(len(values), -1, count).sum(axis=1))

    power = fold(np.abs(weights) ** 2 + 0j).real
    sums = fold(harmonics * np.conj(weights))
    spectrum = sums / (power + _LEAST_WEIGHT * power.max(axis=1, keepdims=True))
    # The spectrum of real levels is its own mirror image, conjugated.
    spectrum[:, 0] = 0.0
    mirror = -np.arange(count) % count
    both = (power + power[:, mirror]) > 0.0
    own = np.where(power >= power[:, mirror], spectrum, np.conj(spectrum[:, mirror]))
    return np.asarray(np.fft.ifft(np.where(both, own, 0.0), axis=1).real)


def _round_levels(levels: FloatArray) -> ByteArray:
    """Round each row of levels to off and on, half-way between the means of either kind."""
    split = 0.5 * (levels.max(axis=1) + levels.min(axis=1))
    for _ in range(8):
        on = levels > split[:, None]
        bright = (levels * on).sum(axis=1) / np.maximum(on.sum(axis=1), 1)
        dark = (levels * ~on).sum(axis=1) / np.maximum((~on).sum(axis=1), 1)
        split = 0.5 * (bright + dark)
    return np.asarray(levels > split[:, None], dtype=np.uint8)


def _likeness(harmonics: Harmonics, models: Harmonics) -> FloatArray:
    """Return the correlation of harmonics with each row of models; -1 with a row of zeros."""
    energy = np.sqrt((np.abs(models) ** 2).sum(axis=1) * float((np.abs(harmonics) ** 2).sum()))
    products = (harmonics * np.conj(models)).real.sum(axis=1)
    return np.where(energy > 0.0, products / np.maximum(energy, 1e-300), -1.0)


def chips_by_descent(
    harmonics: Harmonics, count: int, check: Callable[[], object] = lambda: None
) -> list[ReadPattern]:
    """Find sequences of chips whose harmonics are like those given, the most similar first."""
    exposures, phases = (part.ravel() for part in np.meshgrid(_DENSE_EXPOSURES, _DENSE_PHASES))
    boxes = boxes_of(len(harmonics), count, exposures, phases)
    order = np.arange(1, len(harmonics) + 1)
    of_chips = np.exp(-2j * np.pi / count * np.outer(np.arange(count), order))
    length = float(np.sqrt((np.abs(harmonics) ** 2).sum()))
    found: dict[bytes, ReadPattern] = {}
    rounded = rounded_chips(harmonics, boxes, count)
    trials = zip(boxes, rounded, exposures.tolist(), phases.tolist(), strict=True)
    for box, first, exposure, phase in trials:
        check()
        responses = box * of_chips
        parts = np.hstack([responses.real, responses.imag])
        towards = row_products(np.concatenate([harmonics.real, harmonics.imag]), parts) / length
        chips, alike = _raise_likeness(first, towards, row_products(parts, parts))
        key = min(np.roll(chips, turn).tobytes() for turn in range(count))
        if chips.min() < chips.max() and (key not in found or found[key].explained < alike):
            found[key] = ReadPattern(chips, alike, exposure, phase)
    return sorted(found.values(), key=lambda one: -one.explained)


def _raise_likeness(
    first: ByteArray, towards: FloatArray, products: FloatArray
) -> tuple[ByteArray, float]:
    """Change one chip, or two neighbours, while the likeness c'a / sqrt(c'Qc) of chips c rises.

    ``towards``: the vector a. ``products``: the matrix Q. Constant chips have the likeness -1.
    """
    count, best = len(first), -np.inf
    chips = first.astype(np.float64)
    own, beside = np.diag(products), products[np.arange(count), np.arange(count) - 1]
    # The changes are none, each chip, and each chip with that before it; their likeness follows
    # from the change of the numerator and of the denominator.
    while True:
        signs = 1.0 - 2.0 * chips
        pull = products @ chips
        on, along, energy = (
            np.concatenate([[0.0], one, one + np.roll(one, 1) + both])
            for one, both in (
                (signs, 0.0),
                (signs * towards, 0.0),
                (2.0 * signs * pull + own, 2.0 * signs * np.roll(signs, 1) * beside),
            )
        )
        on, along, energy = on + chips.sum(), along + chips @ towards, energy + chips @ pull
        varies = (on > 0.5) & (on < count - 0.5)
        # Rounding makes any likeness of next to no energy, which is therefore bounded.
        alike = np.where(varies, along / np.sqrt(np.maximum(energy, 1e-12 * own.sum())), -1.0)
        best = max(best, float(alike[0]))
        most = int(alike.argmax())
        if alike[most] <= best + _LEAST_GAIN:
            return chips.astype(np.uint8), float(alike[0])
        best = float(alike[most])
        changed = [most - 1] if most <= count else [most - count - 1, most - count - 2]
        chips[changed] = 1.0 - chips[changed]
