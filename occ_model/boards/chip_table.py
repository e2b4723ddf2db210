"""The packet in a sketch: the comment at the head, and the table of packed chips."""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.boards.transmission import LampTransmission, Transmission
from occ_model.errors import one_line
from occ_model.scene.light_words import describe_light
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Transmitter
from occ_model.scene.units import HERTZ
from occ_model.version import __version__

_BYTES_A_LINE = 12

_SHOWN_CHIPS = 72  # longest packet that the comment shows as zeros and ones


def c_table(chips: ByteArray) -> str:
    return _write_table(chips, "0x{:02X}", ", ", "    {},")


def python_table(chips: ByteArray) -> str:
    return _write_table(chips, "\\x{:02x}", "", '    b"{}"')


def _write_table(chips: ByteArray, octet_form: str, separator: str, line_form: str) -> str:
    """Write chips as lines of bytes, the first chip as the highest bit of the first byte."""
    octets = [octet_form.format(octet) for octet in np.packbits(chips).tolist()]
    starts = range(0, len(octets), _BYTES_A_LINE)
    lines = (separator.join(octets[start : start + _BYTES_A_LINE]) for start in starts)
    return "\n".join(map(line_form.format, lines))


def head_comment(transmission: Transmission, mark: str) -> str:
    """Write what a sketch sends as comment lines that begin with ``mark``.

    No line ends with the user's text, since a backslash at its end would continue the comment.
    """
    if isinstance(transmission, LampTransmission):
        purpose = "shows stripes"
        content = [f"Blinks as a {describe_light(transmission.sent_scene.transmitter)}."]
    else:
        purpose = "can read it"
        content = [
            *_content_lines(transmission.scene.transmitter),
            f"Packet: {len(transmission.chips):,} chips, sent repeatedly.",
            *_chip_lines(transmission.chips),
        ]
    lines = [
        f"Blinks an LED so that a rolling-shutter camera {purpose}: {transmission.board.title}.",
        "",
        *content,
        *frequency_lines(transmission),
        "",
        f"Written by occ_model {__version__}.",
    ]
    return "\n".join(f"{mark} {line}".rstrip() for line in lines)


def _content_lines(transmitter: Transmitter) -> list[str]:
    if transmitter.pattern:
        return ["Sends a raw chip pattern."]
    content = f"the code {transmitter.code} of {transmitter.bits} bits"
    if transmitter.payload:
        content = f'the payload "{one_line(transmitter.payload, _SHOWN_CHIPS)}"'
    return [
        f"Sends {content}.",
        f"Line code {transmitter.line_code}, framing {transmitter.framing}, error correction "
        f"{transmitter.error_correction}.",
    ]


def _chip_lines(chips: ByteArray) -> list[str]:
    if len(chips) > _SHOWN_CHIPS:
        return []
    text = "".join(map(str, chips.tolist()))
    return [" ".join(text[start : start + 8] for start in range(0, len(text), 8))]


def frequency_lines(transmission: Transmission) -> list[str]:
    """State the sent frequency, its error by rounding, and the possible error of the clock."""
    timing = transmission.timing
    comparison = "as asked"
    if float(timing.frequency) != float(timing.requested_frequency):
        error, requested = (
            float(timing.error_ppm),
            HERTZ.format(float(timing.requested_frequency), 9),
        )
        comparison = f"{error:+.3g} ppm from the {requested} asked"
    return [
        f"{transmission.frequency.capitalize()}: {HERTZ.format(float(timing.frequency), 9)}, "
        f"{comparison}:",
        f"a {transmission.unit} lasts {timing.cycles:,} cycles of the "
        f"{HERTZ.format(timing.clock)} clock, which may be off by up to "
        f"{transmission.board.clock_error:,.0f} ppm.",
        *(_lit_lines(transmission) if isinstance(transmission, LampTransmission) else ()),
    ]


def _lit_lines(transmission: LampTransmission) -> list[str]:
    timing, lamp = transmission.timing, transmission.scene.transmitter
    name, value = list(transmission.sent_values.items())[1]
    unit = quantity(name).unit
    comparison = "as asked"
    if value != getattr(lamp, name):
        comparison = f"for the {unit.format(getattr(lamp, name), 9)} asked"
    return [
        f"It is lit for {timing.lit_cycles:,} of them: {quantity(name).label.lower()} "
        f"{unit.format(value, 9)}, {comparison}."
    ]
