"""Bursts of chips at pauses: each has a phase of its own."""

import numpy as np
import pytest
from photo_world.messages import message

import occ_model as occ
from occ_model.photo.chips.bursts import in_phase
from occ_model.photo.chips.edges import Edges
from occ_model.photo.chips.lattice import chips_between, coarsest

CHIP = 6.19
BURST = "1110100101100110100110"


def edges_of_bursts(pause: float) -> Edges:
    """Edges of a burst sent twice, the second one so many chips after the first."""
    chips = np.array([int(chip) for chip in f"0{BURST}0"])
    steps = np.flatnonzero(np.diff(chips)) + 1
    rises = np.diff(chips)[steps - 1] > 0
    later = len(BURST) + pause
    both = [np.concatenate([steps[kind], steps[kind] + later]) for kind in (rises, ~rises)]
    noise = np.random.default_rng(3).normal(0.0, 0.05, (2, len(both[0])))
    return Edges(CHIP * both[0] + noise[0], CHIP * both[1] + noise[1])


@pytest.mark.parametrize("pause", [3.3, 4.4])
def test_a_pause_that_is_no_whole_number_of_chips_is_the_nearest_one(pause: float) -> None:
    edges = edges_of_bursts(pause)
    moved = in_phase(edges)
    assert moved is not None
    lattice = coarsest(moved)
    assert 1.0 / lattice.frequency == pytest.approx(CHIP, rel=0.01)
    found = chips_between(moved, lattice)
    lit = BURST.rstrip("0")
    between = len(BURST) - len(lit) + round(pause)
    assert "".join(map(str, found[0])) == lit + "0" * between + lit


def test_bursts_that_are_whole_chips_apart_stay_where_they_are() -> None:
    assert in_phase(edges_of_bursts(4.0)) is None


@pytest.mark.parametrize("seeds", [range(61000, 61008)])
def test_messages_with_pauses_are_read_rightly_where_they_are_sure(seeds: range) -> None:
    read = []
    for seed in seeds:
        sent = message(seed, pauses=True)
        try:
            reading = occ.read_chips(sent.photo)
        except occ.MatchError:
            continue
        if reading.confidence > 0.9:
            read.append(reading.text in sent.chips)
    assert all(read)
    assert len(read) >= 2
