"""Locate the header and the bits among the chips that are sent or received."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.paper import FRAMING, HEADER_ONES
from occ_model.transmitter.registry import LINE_CODES
from occ_model.transmitter.scheme import scheme_of, sent_chips

_MAX_EXCEPTIONS = 0.05  # largest fraction of columns that a level may put on the wrong side


@dataclass(frozen=True, slots=True)
class PacketField:
    # The index of its first chip, and of the chip after its last
    first: int
    last: int
    bit: int | None  # The number of its bit, from 0; None for the header


def packet_fields(scene: Scene) -> tuple[PacketField, ...]:
    """Return the header and the bits of the packet that a scene sends, as fields of its chips.

    Empty if no packet is sent, if it is not a header followed by the bits, or if a bit has no chips
    of its own.
    """
    transmitter = scene.transmitter
    if transmitter.light != "code" or transmitter.pattern:
        return ()
    code = scheme_of(transmitter).line_code
    # A plug-in's code may be slow, and the fields are needed to draw the window.
    is_known = LINE_CODES.is_built_in(code.name) and code.block_bits == 1
    if transmitter.error_correction != "none" or not is_known:
        return ()
    chips, bits = sent_chips(transmitter), np.array(transmitter.payload_bits, dtype=np.uint8)
    header = len(chips) - code.chips_for(len(bits))
    if header <= 0 or not np.array_equal(chips[header:], code.encode(bits, int(chips[header - 1]))):
        return ()
    starts = range(header, len(chips), code.block_chips)
    data = (PacketField(start, start + code.block_chips, bit) for bit, start in enumerate(starts))
    return (PacketField(0, header, None), *data)


def received_fields(result: DecodeResult, scene: Scene) -> tuple[PacketField, ...]:
    """Return the header and the bits of the packet that a decoder read, in ``result.chips``.

    Empty if no packet was read from its chips, or if all packets were read together.
    """
    fields = packet_fields(scene) if scene.transmitter.framing == FRAMING.name else ()
    if not fields or not result.chips.size or not result.bits.size or len(result.headers) < 2:
        return ()
    run = scheme_of(scene.transmitter).line_code.longest_run
    first, second = result.headers[:2]
    if run is None or run >= HEADER_ONES or second - first != fields[-1].last:
        return ()
    return tuple(
        PacketField(first + field.first, first + field.last, field.bit) for field in fields
    )


def received_edges(result: DecodeResult) -> FloatArray | None:
    """Return where each received chip begins and the last one ends, in columns; None if unknown.

    Column ``i`` of the picture extends from ``i - 0.5`` to ``i + 0.5``. Chips that are
    found as runs of columns have their edges between columns. Decoders that estimate the light
    state instead when a chip is sent, and count time in columns, too: ``i`` is the time at which
    the exposure of column ``i`` begins.
    """
    if result.chip_starts is None or result.region is None or not result.chips.size:
        return None
    columns = np.append(result.chip_starts, float(result.region.columns))
    columns[:-1] -= 0.0 if result.light is not None else 0.5
    columns[-1] -= 0.5
    return np.asarray(columns + result.region.first_column, dtype=np.float64)


def threshold_levels(profile: FloatArray, result: DecodeResult) -> tuple[float, float] | None:
    """Return the neighbouring levels of a profile between which a decoder's threshold lies.

    The decoder compares its enhanced signal with the threshold. Any level between the two divides
    the columns of the profile as the decoder does, with the fewest exceptions, which are columns at
    the panel's sides. None if the signal has no threshold, or with more than 5 % exceptions.
    """
    region, signal = result.region, result.signal
    if result.threshold is None or region is None or signal is None:
        return None
    if result.equalized is not None:  # the threshold is for light, not for the signal
        return None
    levels = profile[region.first_column : region.last_column]
    if len(levels) != len(signal) or len(levels) < 2:
        return None
    order = np.argsort(levels, kind="stable")
    ones = (signal > result.threshold)[order]
    # With the lowest k levels as zeros, count ones among them and zeros among the others.
    exceptions = np.cumsum(ones)[:-1] + np.cumsum(~ones[::-1])[-2::-1]
    best = int(exceptions.argmin())
    if exceptions[best] > _MAX_EXCEPTIONS * len(levels):
        return None
    return float(levels[order[best]]), float(levels[order[best + 1]])
