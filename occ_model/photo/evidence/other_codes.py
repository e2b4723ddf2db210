"""The chips, other than those found, that explain stripes best at the same timing."""

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.fit.timing import ChipLight
from occ_model.products import dot, quadratic_forms, row_products
from occ_model.scene.scene import Transmitter
from occ_model.transmitter.scheme import packet_length, packets_of_codes, sends_paper_code

_MOST_BITS = 12  # largest number of bits for which all codes are compared
_MOST_CHIPS = 512  # number of chips up to which other sequences are compared


def nearest_other(
    profile: FloatArray, found: Hypothesis, transmitter: Transmitter
) -> ByteArray | None:
    """Find the other chips that explain stripes best at the timing of a hypothesis, if any.

    If the chips are as many as those of a packet of ``transmitter``, all its codes are compared; if
    not, sequences in which one chip, or two neighbouring ones, differ.

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
    alone = (ChipLight(one, len(profile)) for one in np.eye(len(chips), dtype=np.uint8))
    responses = np.stack([one.expose(found.fit.timing).lit for one in alone])
    weight = swing**2 / float((swing**2).sum())
    responses -= row_products(weight, responses)[:, None]
    light = light - dot(weight, light)
    towards = row_products(row_products(weight * light, responses), others)
    energy = quadratic_forms(others, row_products(weight * responses, responses))
    likeness = towards / np.sqrt(np.maximum(energy, 1e-12))
    own = {np.roll(chips, turn).tobytes() for turn in range(len(chips))}
    ordered = (others[place].astype(np.uint8) for place in np.argsort(-likeness, kind="stable"))
    return next((one for one in ordered if one.tobytes() not in own), None)


def _others(chips: ByteArray, transmitter: Transmitter) -> FloatArray:
    """Return the sequences to compare, shape (sequences, chips); some are mere rotations."""
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
