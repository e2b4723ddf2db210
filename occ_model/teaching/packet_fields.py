"""Give the places of header and bits among the chips sent, and among the chips received."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results import DecodeResult
from occ_model.scene.scene import Scene, check_scene
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.packet import packet_length, packets, sent_chips

_MOST_EXCEPTIONS = 0.05
"""Largest share of columns that a level may part otherwise than the decoder's threshold."""


@dataclass(frozen=True, slots=True)
class PacketField:
    """A part of a packet.

    Parameters
    ----------
    first, last
        Its first chip, and the one after its last.
    bit
        The number of its bit, the first sent is 0; None for the header.
    """

    first: int
    last: int
    bit: int | None


def packet_fields(scene: Scene) -> tuple[PacketField, ...]:
    """Return header and bits of the packet that a scene sends, by the paper's scheme.

    Returns
    -------
    tuple of PacketField
        Chips are counted from the packet's first; empty where something else is sent.
    """
    check_scene(scene)
    transmitter = scene.transmitter
    papers = packets(np.array([transmitter.code]), transmitter.bits)[0]
    if not np.array_equal(sent_chips(transmitter), papers):
        return ()
    return _fields(0, transmitter.bits)


def received_fields(result: DecodeResult, scene: Scene) -> tuple[PacketField, ...]:
    """Return header and bits of the packet that a decoder read.

    Returns
    -------
    tuple of PacketField
        Chips are counted as in ``result.chips``; empty where no packet was read from chips.
    """
    fields = packet_fields(scene)
    if not fields or not result.chips.size or not result.bits.size or len(result.headers) < 2:
        return ()
    first, second = result.headers[:2]
    if second - first != packet_length(scene.transmitter.bits):
        return ()
    return _fields(first, scene.transmitter.bits)


def _fields(start: int, bits: int) -> tuple[PacketField, ...]:
    data = start + len(HEADER)
    header = PacketField(start, data, None)
    return (header, *(PacketField(data + 2 * bit, data + 2 * bit + 2, bit) for bit in range(bits)))


def received_edges(result: DecodeResult) -> FloatArray | None:
    """Return where each chip received begins in the picture, and where the last one ends.

    Column ``i`` of the picture reaches from ``i - 0.5`` to ``i + 0.5``, and a chip found by its
    columns begins and ends with them. A decoder that finds the chips by their light gives the time
    at which each is sent; the exposure of column ``i`` begins at the time that lies at ``i``.

    Returns
    -------
    ndarray of float64, shape (chips + 1,), or None where no chips were read
    """
    if result.chip_starts is None or result.region is None or not result.chips.size:
        return None
    columns = np.append(result.chip_starts, float(result.region.columns))
    columns[:-1] -= 0.0 if result.light is not None else 0.5
    columns[-1] -= 0.5
    return np.asarray(columns + result.region.first_column, dtype=np.float64)


def threshold_levels(profile: FloatArray, result: DecodeResult) -> tuple[float, float] | None:
    """Return the levels of another profile between which a decoder's threshold lies.

    The decoder compares its signal, which is enhanced, with the threshold. A profile before the
    enhancement has a level, too, that parts the columns as the decoder does. Columns that show
    more than the panel, at its sides, can be on the other side of both.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        The profile of the whole picture.
    result
        The decoder's result.

    Returns
    -------
    (float, float) or None
        Neighbouring levels of columns: any level between them parts zeros from ones with the
        fewest exceptions. None without a threshold of the signal, or where more than one column in
        twenty is an exception.
    """
    region, signal = result.region, result.signal
    if result.threshold is None or region is None or signal is None:
        return None
    if result.equalized is not None:  # the threshold is one of light, not of the signal
        return None
    levels = profile[region.first_column : region.last_column]
    if len(levels) != len(signal) or len(levels) < 2:
        return None
    order = np.argsort(levels, kind="stable")
    ones = (signal > result.threshold)[order]
    # With the lowest k levels taken for zeros: ones among them, and zeros among the others.
    exceptions = np.cumsum(ones)[:-1] + np.cumsum(~ones[::-1])[-2::-1]
    best = int(exceptions.argmin())
    if exceptions[best] > _MOST_EXCEPTIONS * len(levels):
        return None
    return float(levels[order[best]]), float(levels[order[best + 1]])
