"""Chips near to those that harmonics give by division, which explain the harmonics better.

An exposure of two or three chips leaves so little of some harmonics that division gives mostly
their noise, and rounding turns it into wrong chips. From these the chips are changed one or two at
a time, while their harmonics become more like those given; each exposure leads to its own best
chips.
"""

from collections.abc import Callable

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.chips_of_harmonics import Harmonics, ReadPattern, boxes_of, rounded_chips

_EXPOSURES = (0.5, 0.9, 1.15, 1.3, 1.5, 1.7, 1.85, 2.0, 2.15, 2.3, 2.5, 2.7, 2.85, 3.0, 3.15)
_PHASES = np.arange(16) / 16.0
"""Exposures and phases in chips that are tried, twice as dense as for division."""

_LEAST_GAIN = 1e-9  # increase of the likeness beyond rounding error


def chips_by_descent(
    lines: Harmonics, count: int, check: Callable[[], object] = lambda: None
) -> list[ReadPattern]:
    """Find sequences of chips whose harmonics are like those given, the most alike first."""
    exposures, phases = (part.ravel() for part in np.meshgrid(_EXPOSURES, _PHASES))
    boxes = boxes_of(len(lines), count, exposures, phases)
    order = np.arange(1, len(lines) + 1)
    of_chips = np.exp(-2j * np.pi / count * np.outer(np.arange(count), order))
    length = float(np.sqrt((np.abs(lines) ** 2).sum()))
    found: dict[bytes, ReadPattern] = {}
    for box, first, exposure, phase in zip(
        boxes, rounded_chips(lines, boxes, count), exposures.tolist(), phases.tolist(), strict=True
    ):
        check()
        responses = box * of_chips
        towards = (np.conj(responses) * lines).real.sum(axis=1) / length
        chips, alike = _ascended(first, towards, (responses @ np.conj(responses).T).real)
        key = min(np.roll(chips, turn).tobytes() for turn in range(count))
        if chips.min() < chips.max() and (key not in found or found[key].explained < alike):
            found[key] = ReadPattern(chips, alike, exposure, phase)
    return sorted(found.values(), key=lambda one: -one.explained)


def _ascended(
    first: ByteArray, towards: FloatArray, products: FloatArray
) -> tuple[ByteArray, float]:
    """Change chips while their likeness c'a / sqrt(c'Qc) rises.

    One is changed, or two neighbours are, the way that raises it most.
    """
    one = np.eye(len(first), dtype=np.uint8)
    changes = np.concatenate([one, one ^ np.roll(one, 1, axis=1)])
    chips, best = first, float(_alike(first[None], towards, products)[0])
    while True:
        others = chips ^ changes
        alike = _alike(others, towards, products)
        most = int(alike.argmax())
        if alike[most] <= best + _LEAST_GAIN:
            return chips, best
        chips, best = others[most], float(alike[most])


def _alike(chips: ByteArray, towards: FloatArray, products: FloatArray) -> FloatArray:
    """Return the likeness of each row of chips; that of chips without a change is -1."""
    energy = np.einsum("ij,ij->i", chips @ products, chips)
    varies = chips.min(axis=1) < chips.max(axis=1)
    return np.where(varies, chips @ towards / np.sqrt(np.maximum(energy, 1e-300)), -1.0)
