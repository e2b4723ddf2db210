"""A given preamble, and the line-coded payload after it."""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.framings.framing import (
    Framed,
    FrameFormat,
    Framing,
    preamble_of,
)
from occ_model.transmitter.framings.repeated_frame import read_repeated


def _encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
    preamble = preamble_of(form)
    return np.concatenate([preamble, form.line_code.encode(bits, int(preamble[-1]))])


def _decode(chips: ByteArray, form: FrameFormat) -> Framed:
    return read_repeated(chips, preamble_of(form), form.bits, form, read_after)


def read_after(data: ByteArray, level: int, form: FrameFormat) -> Framed:
    """Read a payload of known length from the chips after a preamble, whose last is ``level``."""
    read = form.line_code.decode(data[: form.line_code.chips_for(form.bits)], level)
    bits, padding = read.bits[: form.bits], read.bits[form.bits :]
    failure = read.failure
    if failure is None and padding.any():
        failure = "The bits that fill the last block are not 0: some chips were misread."
    return Framed((), bits, failure)


FRAMING = Framing(
    "preamble",
    "A preamble, then the payload",
    checks=False,
    encode=_encode,
    decode=_decode,
)
