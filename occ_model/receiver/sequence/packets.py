"""Packets among chips that are known more or less surely: the repetitions are added up.

A chip's log-likelihood ratio is positive where it is likelier lit than not. The same packet is sent
over and over, so the ratios of chips that are a packet apart add up. The packet starts where the
header and the line code fit them best.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.packet import packet_length

_SURE = 700.0
"""Log-likelihood ratio above which its exponential is not told from infinity."""


@dataclass(frozen=True, eq=False, slots=True)
class SoftPacket:
    """The likeliest packet.

    Parameters
    ----------
    start
        The first chip of its header, within the first packet's length of chips.
    bits : ndarray of uint8, shape (bits,)
        Its bits.
    likelihoods : ndarray of float64, shape (bits,)
        The probability that each bit is right, from 0.5 to 1.
    certainty
        The probability that the packet starts there and that all its bits are right.
    """

    start: int
    bits: ByteArray
    likelihoods: FloatArray
    certainty: float


def likeliest_packet(ratios: FloatArray, bits: int) -> SoftPacket:
    """Find the likeliest packet of a number of bits, sent repeatedly.

    Parameters
    ----------
    ratios : ndarray of float64, shape (chips,)
        Log-likelihood ratio of each chip; at least one packet.
    bits
        Bits of a packet.
    """
    length = packet_length(bits)
    folded = np.bincount(np.arange(len(ratios)) % length, ratios, minlength=length)
    rotated = folded[(np.arange(length)[:, None] + np.arange(length)) % length]
    # Either chip of a pair follows from the other one, so that both say the same: half of each.
    header = rotated[:, : len(HEADER)] @ (np.array(HEADER) - 0.5)
    pairs = rotated[:, len(HEADER) :].reshape(length, bits, 2)
    levels = 0.5 * (pairs[..., 1] - pairs[..., 0])
    score = header + np.abs(levels).sum(axis=1)
    start = int(score.argmax())
    level = np.concatenate([[0], (levels[start] > 0.0).astype(np.uint8)])
    sureness = np.abs(levels[start])
    # A bit is the change of the level: wrong where one of both levels is.
    least = np.minimum(sureness, np.concatenate([[_SURE], sureness[:-1]]))
    others = np.delete(score, start)
    lead = min(float(score[start] - others.max()), _SURE)
    right = _probability(sureness).prod() / (1.0 + np.exp(-lead))
    changed = (level[1:] ^ level[:-1] ^ 0).astype(np.uint8)
    return SoftPacket(start, changed, _probability(least), float(right))


def _probability(ratio: FloatArray) -> FloatArray:
    return np.asarray(1.0 / (1.0 + np.exp(-np.minimum(ratio, _SURE))))
