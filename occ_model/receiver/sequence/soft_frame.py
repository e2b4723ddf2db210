"""Read a frame from uncertain chips by adding up its repetitions.

A chip's log-likelihood ratio is positive if it is more likely lit than dark. The same frame is sent
repeatedly, so the ratios of chips that are a period apart add up. The paper's packet starts where
header and line code fit best; for other schemes the more likely value of each chip is read.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.scheme import Scheme, packet_length

_MAX_LOG_RATIO = 700.0  # log-likelihood ratio above which the exponential overflows
_REPETITIONS = 3  # periods given to a framing, so that one lies entirely between two headers


@dataclass(frozen=True, eq=False, slots=True)
class SoftFrame:
    framed: Framed
    certainty: float = 0.0  # Probability that all its bits are correct; 0 if none was read
    # Shape (bits,): probability that each bit is correct; None if the chips that determine a bit
    # are unknown
    likelihoods: FloatArray | None = None


def read_frame(ratios: FloatArray, scheme: Scheme, header: tuple[int, ...]) -> SoftFrame:
    """Read the most likely frame from log-likelihood ratios; ``header``: its first chips."""
    length = scheme.length
    if len(ratios) < length:
        return SoftFrame(scheme.decode((ratios > 0.0).astype(np.uint8)))
    phases = np.arange(len(ratios)) % length
    folded = np.bincount(phases, ratios, minlength=length).astype(np.float64)
    if scheme.is_papers:
        return find_most_likely_packet(folded, scheme.bits)
    period = (folded > 0.0).astype(np.uint8)
    framed = scheme.decode(np.tile(period, _REPETITIONS))
    if framed.failure is not None or not framed.bits.size:
        return SoftFrame(framed)
    frame_chips = scheme.encode(framed.bits)
    return SoftFrame(
        framed,
        *_certainties(np.roll(folded, -_find_start(folded, frame_chips)), framed, scheme, header),
    )


def find_most_likely_packet(folded: FloatArray, bits: int) -> SoftFrame:
    """Find the most likely packet of the paper's scheme in a folded period with any start."""
    length = packet_length(bits)
    rotated = folded[(np.arange(length)[:, None] + np.arange(length)) % length]
    # Each chip of a pair determines the other one, so each counts half.
    header = rotated[:, : len(HEADER)] @ (np.array(HEADER) - 0.5)
    pairs = rotated[:, len(HEADER) :].reshape(length, bits, 2)
    levels = 0.5 * (pairs[..., 1] - pairs[..., 0])
    score = header + np.abs(levels).sum(axis=1)
    start = int(score.argmax())
    sent_levels = np.concatenate([[HEADER[-1]], levels[start] > 0.0]).astype(np.uint8)
    ratios = np.abs(levels[start])
    # A bit is 1 if the level changes, so it is wrong if either level is.
    bit_ratios = np.minimum(ratios, np.concatenate([[_MAX_LOG_RATIO], ratios[:-1]]))
    lead = min(float(score[start] - np.delete(score, start).max()), _MAX_LOG_RATIO)
    certainty = probability(ratios).prod() / (1.0 + np.exp(-lead))
    framed = Framed((start,), sent_levels[1:] ^ sent_levels[:-1])
    return SoftFrame(framed, float(certainty), probability(bit_ratios))


def _find_start(folded: FloatArray, frame_chips: ByteArray) -> int:
    """Find the chip of a folded period at which the frame starts."""
    spectrum = np.fft.rfft(folded) * np.conj(np.fft.rfft(frame_chips - 0.5))
    return int(np.fft.irfft(spectrum, len(folded)).argmax())


def _certainties(
    ratios: FloatArray, framed: Framed, scheme: Scheme, header: tuple[int, ...]
) -> tuple[float, FloatArray | None]:
    """Return the probability that all bits are correct, and that of each bit."""
    frame_chips, code = scheme.encode(framed.bits), scheme.line_code
    chip_certainties = probability(np.where(frame_chips == 1, ratios, -ratios))
    # The chips of a block depend on each other, so the least certain chip represents them.
    blocks = -(-len(framed.bits) // code.block_bits)
    first, size = len(header), code.block_chips
    if not np.array_equal(
        frame_chips[first : first + blocks * size],
        code.encode(framed.bits, header[-1] if header else 0),
    ):
        return float(chip_certainties.prod()), None
    block_certainties = (
        chip_certainties[first : first + blocks * size].reshape(blocks, size).min(axis=1)
    )
    # A block may depend on the chip before it.
    previous_certainties = np.concatenate([[1.0], block_certainties[:-1]])
    bit_certainties = np.repeat(
        np.minimum(block_certainties, previous_certainties), code.block_bits
    )[: len(framed.bits)]
    return float(block_certainties.prod()), bit_certainties


def probability(ratio: FloatArray) -> FloatArray:
    """Convert a log-likelihood ratio to a probability."""
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(ratio, -_MAX_LOG_RATIO, _MAX_LOG_RATIO))))
