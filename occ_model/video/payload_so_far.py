"""The payload by the joined chips of all frames, and why it was not read."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, IndexArray
from occ_model.errors import counted
from occ_model.receiver.sequence.soft_frame import SoftFrame
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.raw import FRAMING as RAW
from occ_model.transmitter.framings.raw import count_length_bits
from occ_model.video.joining import Joined
from occ_model.video.period import SentPeriod
from occ_model.video.read_frame import TimedFrame

UNKNOWN = "·"  # in place of a letter, a byte or a bit that has not been in view

_MIN_CERTAINTY = 0.9  # least probability that all bits are right, of a payload that is read

NO_CLOCK = (
    "The frame times do not determine a clock: no frequency that the readout time allows explains "
    "what the frames show, or too many do. Packets are not counted."
)


def known_bits(joined: Joined, period: SentPeriod) -> IndexArray:
    """Return the payload's bits by the chips in view: 0, 1, or -1 where unknown."""
    scheme = period.scheme
    if scheme is None or scheme.correction != "none":
        return np.full(0 if scheme is None else scheme.bits, -1, dtype=np.int64)
    chips = (joined.ratios > 0.0).astype(np.uint8)
    known = joined.known
    if period.parts > 1:
        return _of_parts(chips, known, period)
    return _of_blocks(chips, known, period)


def _of_parts(chips: ByteArray, known: BoolArray, period: SentPeriod) -> IndexArray:
    assert period.scheme is not None  # noqa: S101 - the caller has asked
    bits = np.full(period.scheme.bits, -1, dtype=np.int64)
    for part in range(period.parts):
        here = slice(part * period.part_length, (part + 1) * period.part_length)
        found = period.part_bits(chips[here]) if known[here].all() else None
        if found is not None and found[0] == part:
            bits[period.slice_of_part(part)] = found[1]
    return bits


def _of_blocks(chips: ByteArray, known: BoolArray, period: SentPeriod) -> IndexArray:
    scheme, start = period.scheme, period.data_start
    assert scheme is not None  # noqa: S101 - the caller has asked
    bits = np.full(scheme.bits, -1, dtype=np.int64)
    if start is None:
        return bits
    code = scheme.line_code
    data = chips[start:]
    blocks = len(data) // code.block_chips
    read = code.decode(data[: blocks * code.block_chips], int(chips[start - 1]))
    of_chips = known[start : start + blocks * code.block_chips]
    of_block = np.asarray(of_chips.reshape(blocks, -1).all(axis=1))
    # A block may count from the chip before it.
    of_block &= np.concatenate([[known[start - 1]], of_block[:-1]])
    of_bits = np.repeat(of_block, code.block_bits)[: len(read.bits)]
    skipped = count_length_bits(scheme.bits) if scheme.framing.name == RAW.name else 0
    own = read.bits[: len(of_bits)].astype(np.int64)
    values = np.where(of_bits, own, -1)[skipped : skipped + scheme.bits]
    bits[: len(values)] = values
    return bits


def written(bits: IndexArray, scene: Scene) -> str:
    """Format bits, unknown ones -1, in the form of the scene's payload, a code in bits."""
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
    """Return the probability that all bits are right, by the votes and by what the code finds.

    With c the probability that no chip is wrong, -ln c is the expected number of wrong ones. A code
    that finds any single wrong chip has excluded just one; what remains is none, or two and more.
    """
    if soft is None or soft.framed.failure is not None or period.scheme is None:
        return 0.0
    certainty = soft.certainty
    if period.scheme.finds_wrong_chip and 0.0 < certainty < 1.0:
        certainty /= 1.0 + certainty * math.log(certainty)
    return certainty


def why_unplaced(frames: Sequence[TimedFrame]) -> str:
    """Explain why no frame could be placed in what is sent, by the first one's own failure."""
    if not frames:
        return "The film holds no frames."
    read = [frame for frame in frames if frame.is_read]
    if not read:
        why = frames[0].reading.failure
        return f"None of {counted(len(frames), 'frame')} shows chips; of the first one: {why}"
    why = read[0].problem
    rest = (
        "no header shows it, and the chips fit no place."
        if why is None
        else f"of the first one: {why}"
    )
    frames_read = counted(len(read), "frame")
    return f"The place in the packet of none of {frames_read} with chips is known; {rest}"


def why_not_read(soft: SoftFrame | None, joined: Joined, period: SentPeriod) -> str | None:
    """Explain why the joined chips of all frames yield no payload; None where they do."""
    if period.scheme is None:
        return "A raw chip pattern is sent, which holds no packets."
    if soft is None:
        return _why_incomplete(joined, period)
    if soft.framed.failure is not None:
        return soft.framed.failure
    certainty = certainty_of(soft, period)
    if certainty < _MIN_CERTAINTY and not period.scheme.framing.checks:
        return (
            f"The chips are not certain enough: that all {period.scheme.bits} bits are right has a "
            f"probability of {certainty:.2g}."
        )
    return None


def _why_incomplete(joined: Joined, period: SentPeriod) -> str:
    unseen = ~joined.known
    text = (
        f"{int(unseen.sum())} of {period.length} chips were in no frame whose place in the packet "
        "is known; a longer film may show them."
    )
    if period.parts > 1:
        missing = np.flatnonzero(unseen.reshape(period.parts, -1).any(axis=1))
        text += f" The first sub-packet that lacks some is number {int(missing[0]) + 1}."
    return text
