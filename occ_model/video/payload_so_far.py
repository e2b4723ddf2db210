"""Read the payload from the joined chips of all frames, or explain why it is not read."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.errors import inflect
from occ_model.receiver.sequence.soft_frame import SoftFrame
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.raw import FRAMING as RAW, count_length_bits
from occ_model.video.period import SentPeriod
from occ_model.video.read_frame import TimedFrame

UNKNOWN = "·"  # stands for a letter, byte or bit that no frame shows

_MIN_CERTAINTY = 0.9  # minimum probability that all bits are correct for a payload to be read

NO_CLOCK = "The film gives no clock"


def known_bits(ratios: FloatArray, known: BoolArray, period: SentPeriod) -> IndexArray:
    """Return the payload's bits according to the chips in view: 0, 1, or -1 if unknown.

    ``ratios``: the log-likelihood ratios of the period's chips. ``known``: which of them are known.
    """
    scheme = period.scheme
    if scheme is None or scheme.correction != "none":
        return np.full(0 if scheme is None else scheme.bits, -1, dtype=np.int64)
    chips = (ratios > 0.0).astype(np.uint8)
    if period.parts > 1:
        return _bits_of_parts(chips, known, period)
    return _bits_of_blocks(chips, known, period)


def _bits_of_parts(chips: ByteArray, known: BoolArray, period: SentPeriod) -> IndexArray:
    assert period.scheme is not None  # noqa: S101 - the caller has checked
    bits = np.full(period.scheme.bits, -1, dtype=np.int64)
    for part in range(period.parts):
        chip_range = slice(part * period.part_length, (part + 1) * period.part_length)
        number_and_bits = period.read_part(chips[chip_range]) if known[chip_range].all() else None
        if number_and_bits is not None and number_and_bits[0] == part:
            bits[period.slice_of_part(part)] = number_and_bits[1]
    return bits


def _bits_of_blocks(chips: ByteArray, known: BoolArray, period: SentPeriod) -> IndexArray:
    scheme, start = period.scheme, period.data_start
    assert scheme is not None  # noqa: S101 - the caller has checked
    bits = np.full(scheme.bits, -1, dtype=np.int64)
    if start is None:
        return bits
    code = scheme.line_code
    data = chips[start:]
    blocks = len(data) // code.block_chips
    decoded = code.decode(data[: blocks * code.block_chips], int(chips[start - 1]))
    chips_known = known[start : start + blocks * code.block_chips]
    blocks_known = np.asarray(chips_known.reshape(blocks, -1).all(axis=1))
    # A block may depend on the chip before it.
    blocks_known &= np.concatenate([[known[start - 1]], blocks_known[:-1]])
    bits_known = np.repeat(blocks_known, code.block_bits)[: len(decoded.bits)]
    length_bits = count_length_bits(scheme.bits) if scheme.framing.name == RAW.name else 0
    decoded_bits = decoded.bits[: len(bits_known)].astype(np.int64)
    values = np.where(bits_known, decoded_bits, -1)[length_bits : length_bits + scheme.bits]
    bits[: len(values)] = values
    return bits


def format_bits(bits: IndexArray, scene: Scene) -> str:
    """Format bits, with -1 for unknown ones, in the form of the scene's payload, a code as bits."""
    form = form_of(scene.transmitter.payload) if scene.transmitter.payload else "bits"
    if form == "bits":
        return "".join(UNKNOWN if bit < 0 else str(bit) for bit in bits.tolist())
    if form == "text" and not (bits < 0).any():
        return payload_of_bits(bits.tolist(), form)
    octets = bits[: len(bits) // 8 * 8].reshape(-1, 8)
    digits = 2 if form == "hex" else 1
    return "".join(
        UNKNOWN * digits if (octet < 0).any() else payload_of_bits(octet.tolist(), form)
        for octet in octets
    )


def certainty_of(soft: SoftFrame | None, period: SentPeriod) -> float:
    """Return the probability that all bits are correct, by the chips and the code's own check.

    With c the probability that no chip is wrong, -ln c is the expected number of wrong ones. A code
    that detects any single wrong chip has excluded exactly one wrong chip; none, or two and more,
    remain possible.
    """
    if soft is None or soft.framed.failure is not None or period.scheme is None:
        return 0.0
    certainty = soft.certainty
    if period.scheme.finds_wrong_chip and 0.0 < certainty < 1.0:
        certainty /= 1.0 + certainty * math.log(certainty)
    return certainty


def explain_unplaced(frames: Sequence[TimedFrame]) -> str:
    """Explain why no frame could be placed, by the failure of the first one."""
    if not frames:
        return "The film contains no frames."
    read_frames = [frame for frame in frames if frame.is_read]
    if not read_frames:
        why = frames[0].reading.failure
        return f"None of {inflect(len(frames), 'frame')} shows chips. The first one: {why}"
    why = read_frames[0].problem
    explanation = (
        "No header shows it, and the chips fit no place."
        if why is None
        else f"The first one: {why}"
    )
    frames_read = inflect(len(read_frames), "frame")
    return (
        f"The place in the packet is not known for any of {frames_read} with chips. {explanation}"
    )


def explain_unread(soft: SoftFrame | None, known: BoolArray, period: SentPeriod) -> str | None:
    """Explain why the joined chips of all frames yield no payload; None if they do."""
    if period.scheme is None:
        return "A raw chip pattern is sent, which contains no packets."
    if soft is None:
        return _explain_incomplete(known, period)
    if soft.framed.failure is not None:
        return soft.framed.failure
    certainty = certainty_of(soft, period)
    if certainty < _MIN_CERTAINTY and not period.scheme.framing.checks:
        return (
            f"The chips are not certain enough: all {period.scheme.bits} bits are correct with a "
            f"probability of only {certainty:.2g}."
        )
    return None


def _explain_incomplete(known: BoolArray, period: SentPeriod) -> str:
    unknown = ~known
    text = (
        f"{int(unknown.sum())} of {period.length} chips are in no frame whose place in the packet "
        "is known; a longer film may show them."
    )
    if period.parts > 1:
        missing = np.flatnonzero(unknown.reshape(period.parts, -1).any(axis=1))
        text += f" The first incomplete sub-packet is number {int(missing[0]) + 1}."
    return text
