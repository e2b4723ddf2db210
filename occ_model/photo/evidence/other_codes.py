"""The chips besides those found that explain stripes best at the same timing."""

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.fit.timing import Timing
from occ_model.scene.scene import Transmitter
from occ_model.transmitter.scheme import packet_length, packets_of_codes, sends_paper_code

_MOST_BITS = 12  # bits up to which all codes are compared, and not those of one other chip
_MOST_CHIPS = 512  # number of chips up to which other sequences are compared


def nearest_other(
    profile: FloatArray, found: Hypothesis, transmitter: Transmitter
) -> ByteArray | None:
    """Find the other chips that explain stripes best at the timing of a hypothesis, if any.

    ``transmitter``: its packets are compared where the chips found are as many; else sequences that
    differ in one chip, or in two neighbours that are exchanged.

    A column's lit fraction is linear in the chips: with the responses A of the columns to each chip
    and the profile y, both about their means, chips c have the correlation c'A'y / |Ac| |y|.
    """
    chips = found.chips
    if len(chips) > _MOST_CHIPS:
        return None
    others = _others(chips, transmitter)
    if len(others) == 0:
        return None
    swing = found.fit.swing
    light = (profile - found.fit.low) / swing
    responses = _responses(found.fit.timing, len(chips), len(profile))
    weight = swing**2 / float((swing**2).sum())
    responses = responses - weight @ responses
    light = light - float(weight @ light)
    towards = others @ (responses.T @ (weight * light))
    products = responses.T @ (weight[:, None] * responses)
    energy = np.einsum("ij,ij->i", others @ products, others)
    likeness = towards / np.sqrt(np.maximum(energy, 1e-12))
    own = {np.roll(chips, turn).tobytes() for turn in range(len(chips))}
    ordered = (others[place].astype(np.uint8) for place in np.argsort(-likeness, kind="stable"))
    return next((one for one in ordered if one.tobytes() not in own), None)


def _others(chips: ByteArray, transmitter: Transmitter) -> FloatArray:
    """Return the sequences to compare, shape (sequences, chips), also the given one turned."""
    count = len(chips)
    turn = (np.arange(count)[:, None] + np.arange(count)) % count
    is_packet = sends_paper_code(transmitter) and count == packet_length(transmitter.bits)
    if is_packet and transmitter.bits <= _MOST_BITS:
        all_codes = packets_of_codes(np.arange(2**transmitter.bits), transmitter.bits)
        others = all_codes[:, turn].reshape(-1, count)
    else:
        one = np.eye(count, dtype=np.uint8)
        others = chips ^ np.concatenate([one, one ^ np.roll(one, 1, axis=1)])
    changes = others.min(axis=1) != others.max(axis=1)
    return np.asarray(others[changes], dtype=np.float64)


def _responses(timing: Timing, chips: int, columns: int) -> FloatArray:
    """Return the lit fraction of each column that each chip alone makes, shape (columns, chips).

    A chip's running integral over time rises by one while it lasts, once a period.
    """
    start = timing.start(columns) + timing.step * np.arange(columns, dtype=np.float64)
    chip = np.arange(chips)

    def until(place: FloatArray) -> FloatArray:
        turns = np.floor(place / chips)
        within = np.clip((place - turns * chips)[:, None] - chip, 0.0, 1.0)
        return np.asarray(within + turns[:, None])

    return np.asarray((until(start + timing.exposure) - until(start)) / timing.exposure)
