"""A frame among chips that are known more or less surely: its repetitions are added up.

A chip's log-likelihood ratio is positive where it is likelier lit than not. The same frame is sent
over and over, so the ratios of chips that are a period apart add up. The paper's packet starts
where header and line code fit them best; other schemes read the likelier value of each chip.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.packet import packet_length
from occ_model.transmitter.scheme import Scheme

_MAX_LOG_RATIO = 700.0  # log-likelihood ratio above which its exponential overflows
_REPETITIONS = 3  # periods that a framing is shown, so that one lies whole between two headers


@dataclass(frozen=True, eq=False, slots=True)
class SoftFrame:
    framed: Framed
    certainty: float = 0.0  # The probability that all its bits are right, 0 where none were read
    # Shape (bits,), or None: the probability that each bit is right; None where the framing hides
    # which chips say it
    likelihoods: FloatArray | None = None


def read_frame(ratios: FloatArray, scheme: Scheme, header: tuple[int, ...]) -> SoftFrame:
    """Read the likeliest frame by each chip's log-likelihood ratio; ``header``: known chips."""
    length = scheme.length
    if len(ratios) < length:
        return SoftFrame(scheme.decode((ratios > 0.0).astype(np.uint8)))
    places = np.arange(len(ratios)) % length
    folded = np.bincount(places, ratios, minlength=length).astype(np.float64)
    if scheme.is_papers:
        return likeliest_packet(folded, scheme.bits)
    period = (folded > 0.0).astype(np.uint8)
    framed = scheme.decode(np.tile(period, _REPETITIONS))
    if framed.failure is not None or not framed.bits.size:
        return SoftFrame(framed)
    sent = scheme.encode(framed.bits)
    return SoftFrame(
        framed, *_sureness(np.roll(folded, -_start(folded, sent)), framed, scheme, header)
    )


def likeliest_packet(folded: FloatArray, bits: int) -> SoftFrame:
    """Find the likeliest packet of the paper's scheme in a folded period, which starts anywhere."""
    length = packet_length(bits)
    rotated = folded[(np.arange(length)[:, None] + np.arange(length)) % length]
    # Either chip of a pair follows from the other one, so that both say the same: half of each.
    header = rotated[:, : len(HEADER)] @ (np.array(HEADER) - 0.5)
    pairs = rotated[:, len(HEADER) :].reshape(length, bits, 2)
    levels = 0.5 * (pairs[..., 1] - pairs[..., 0])
    score = header + np.abs(levels).sum(axis=1)
    start = int(score.argmax())
    level = np.concatenate([[HEADER[-1]], levels[start] > 0.0]).astype(np.uint8)
    sureness = np.abs(levels[start])
    # A bit is 1 where the level changes: wrong where one of both levels is.
    least = np.minimum(sureness, np.concatenate([[_MAX_LOG_RATIO], sureness[:-1]]))
    lead = min(float(score[start] - np.delete(score, start).max()), _MAX_LOG_RATIO)
    right = probability(sureness).prod() / (1.0 + np.exp(-lead))
    framed = Framed((start,), level[1:] ^ level[:-1])
    return SoftFrame(framed, float(right), probability(least))


def _start(folded: FloatArray, sent: ByteArray) -> int:
    """Find the chip of a period, which starts anywhere, at which the frame sent starts."""
    spectrum = np.fft.rfft(folded) * np.conj(np.fft.rfft(sent - 0.5))
    return int(np.fft.irfft(spectrum, len(folded)).argmax())


def _sureness(
    ratios: FloatArray, framed: Framed, scheme: Scheme, header: tuple[int, ...]
) -> tuple[float, FloatArray | None]:
    """Return the probability that all bits are right, and that of each."""
    sent, code = scheme.encode(framed.bits), scheme.line_code
    right = probability(np.where(sent == 1, ratios, -ratios))
    # The chips of a block say the same, so that the least sure of them stands for it.
    blocks = -(-len(framed.bits) // code.block_bits)
    first, size = len(header), code.block_chips
    if not np.array_equal(
        sent[first : first + blocks * size], code.encode(framed.bits, header[-1] if header else 0)
    ):
        return float(right.prod()), None
    of_blocks = right[first : first + blocks * size].reshape(blocks, size).min(axis=1)
    # A block may count from the chip before it.
    before = np.concatenate([[1.0], of_blocks[:-1]])
    of_bits = np.repeat(np.minimum(of_blocks, before), code.block_bits)[: len(framed.bits)]
    return float(of_blocks.prod()), of_bits


def probability(ratio: FloatArray) -> FloatArray:
    """Convert a log-likelihood ratio to a probability."""
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(ratio, -_MAX_LOG_RATIO, _MAX_LOG_RATIO))))
