"""Colour shift keying: bits as colours, each a mixture of three LEDs of constant total power.

The points are those of IEEE 802.15.7, in fractions of the power of the LEDs of the bands i, j and
k, here red, green and blue. The standard's own text was not at hand. The labels of 16 points are
those that US patent 9467232 states in its first claim, where S0 is the centroid: then neighbours
differ in one bit, except in the three pairs that the claim names. (Papers that number the points
from the vertex J, as A. Yokoi et al. did in 2010, would have others.) The labels of 4 and 8 points,
and the bands, are those of public implementations, which agree. Slides of May 2010, before the
standard, have other centres of the bands.
"""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.parameters.colour import CSK_ORDERS

PARTS = 18  # the power of an LED in each point is a whole number of these parts

POINTS: dict[str, tuple[tuple[int, int, int], ...]] = {
    # Red, green and blue, in parts, in the order of the labels
    "4-csk": ((0, 18, 0), (6, 6, 6), (0, 0, 18), (18, 0, 0)),
    "8-csk": (
        (0, 12, 6), (2, 5, 11), (11, 5, 2), (9, 0, 9), (0, 18, 0), (0, 0, 18), (6, 12, 0),
        (18, 0, 0),
    ),
    "16-csk": (
        (0, 18, 0), (2, 14, 2), (2, 8, 8), (0, 12, 6), (12, 6, 0), (6, 12, 0), (6, 6, 6), (8, 8, 2),
        (18, 0, 0), (0, 0, 18), (0, 6, 12), (2, 2, 14), (12, 0, 6), (14, 2, 2), (8, 2, 8),
        (6, 0, 12),
    ),
}  # fmt: skip

BANDS = (
    (380, 478, 0.169, 0.007), (478, 540, 0.011, 0.733), (540, 588, 0.402, 0.597),
    (588, 633, 0.669, 0.331), (633, 679, 0.729, 0.271), (679, 726, 0.734, 0.265),
    (726, 780, 0.734, 0.265),
)  # fmt: skip
"""From and to in nm, and the chromaticity x, y (CIE 1931) of the centre, of bands 000 to 110."""

COMBINATIONS = ("620", "610", "520", "510", "420", "410", "320", "310", "210")
"""The bands i, j and k that the standard combines."""

HEADER = 2
"""Dark symbols that start a packet: no point is dark, so that the sum of the colours shows them."""


def bits_a_symbol(order: str) -> int:
    return CSK_ORDERS[order].bit_length() - 1


def symbols_of(order: str, bits: Sequence[int]) -> list[int]:
    """Return the labels that carry some bits, first bit first; missing last bits are 0."""
    width = bits_a_symbol(order)
    padded = [*bits, *[0] * (-len(bits) % width)]
    groups = (padded[first : first + width] for first in range(0, len(padded), width))
    return [int("".join(map(str, group)), 2) for group in groups]


def bits_of(order: str, symbols: Sequence[int], count: int) -> list[int]:
    """Return the first bits of some labels, the inverse of :func:`symbols_of`."""
    width = bits_a_symbol(order)
    return [int(bit) for symbol in symbols for bit in f"{symbol:0{width}b}"][:count]


def levels_of_colour(order: str, bits: Sequence[int], index: int) -> str:
    """Return the levels of one LED over a packet, as the text of a waveform."""
    parts = [POINTS[order][symbol][index] for symbol in symbols_of(order, bits)]
    return f"{' '.join(map(str, [0] * HEADER + parts))} / {PARTS}"


def csk_chromaticities(order: str, bands: str) -> FloatArray:
    """Return the chromaticity that the standard gives each point, in the order of the labels.

    It mixes those of the bands' centres by the powers.

    Parameters
    ----------
    order
        ``"4-csk"``, ``"8-csk"`` or ``"16-csk"``.
    bands
        The bands of the red, green and blue LED, such as ``"420"``: one of the nine combinations of
        IEEE 802.15.7.

    Returns
    -------
    ndarray of float64, shape (points, 2)
        x and y of CIE 1931.

    Raises
    ------
    ParameterError
        There is no such order or combination.
    """
    check_choice("order", order, tuple(CSK_ORDERS))
    check_choice("bands", bands, COMBINATIONS)
    corners = np.array([BANDS[int(band)][2:] for band in bands])
    return np.asarray(np.array(POINTS[order]) @ corners / PARTS)
