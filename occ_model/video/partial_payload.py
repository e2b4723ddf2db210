"""The payload as far as it is known, before all of it has been in view."""

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, IndexArray
from occ_model.scene.payload import form_of, payload_of_bits
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.raw import FRAMING as RAW
from occ_model.transmitter.framings.raw import length_bits
from occ_model.video.joining import Joined
from occ_model.video.period import SentPeriod

UNKNOWN = "·"  # in place of a letter, a byte or a bit that has not been in view


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
    skipped = length_bits(scheme.bits) if scheme.framing.name == RAW.name else 0
    told = read.bits[: len(of_bits)].astype(np.int64)
    values = np.where(of_bits, told, -1)[skipped : skipped + scheme.bits]
    bits[: len(values)] = values
    return bits


def written(bits: IndexArray, scene: Scene) -> str:
    """Write bits, unknown ones -1, in the form of the scene's payload, a code in bits."""
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
