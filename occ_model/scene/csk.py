"""Colour shift keying: bits as colours, each a mixture of three LEDs of constant total power.

The points are those of IEEE 802.15.7 as four public implementations have them, in fractions of the
power of the LEDs of the bands i, j and k, here red, green and blue. Labels differ between sources:
for 16 points they are those of US patent 9467232 where it states them; otherwise a point's label is
its place in the list.
"""

from collections.abc import Sequence

from occ_model.scene.parameters.colour import CSK_ORDERS

PARTS = 18  # the power of an LED in each point is a whole number of these parts

POINTS: dict[str, tuple[tuple[int, int, int], ...]] = {
    # Red, green and blue, in parts
    "4-csk": ((18, 0, 0), (0, 18, 0), (0, 0, 18), (6, 6, 6)),
    "8-csk": (
        (18, 0, 0), (0, 18, 0), (0, 0, 18), (6, 12, 0), (0, 12, 6), (9, 0, 9), (2, 5, 11),
        (11, 5, 2),
    ),
    "16-csk": (
        (0, 18, 0), (2, 14, 2), (0, 12, 6), (2, 8, 8), (6, 12, 0), (8, 8, 2), (6, 6, 6), (0, 6, 12),
        (18, 0, 0), (0, 0, 18), (14, 2, 2), (12, 0, 6), (12, 6, 0), (2, 2, 14), (8, 2, 8),
        (6, 0, 12),
    ),
}  # fmt: skip

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
