"""The chips in view are read without a period."""

import numpy as np
import pytest
from amount import amount
from lit_fractions import light_of
from model.photo.chips.edge_kinds import edges_at
from photo_world.messages import message
from simulated_photos import photo_of

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.photo.chips.edges import (
    Edges,
    chips_between,
    find_coarsest,
    lattice_at,
    part_between_rims,
)
from occ_model.photo.chips.read import align_bursts
from occ_model.photo.fit.timing import Timing


def random_chips(seed: int, count: int = 60) -> ByteArray:
    """Draw chips that repeat nowhere."""
    return np.random.default_rng(seed).integers(0, 2, count).astype(np.uint8)


def picture(chips: ByteArray, columns: float, exposure: float) -> ByteArray:
    """Photograph chips once, with noise."""
    timing = Timing(1.0 / columns, exposure, 0.5 * len(chips), 1.0)
    lit = light_of(chips, timing, int(0.95 * len(chips) * columns))
    noise = np.random.default_rng(1).standard_normal((40, len(lit)))
    return np.clip(np.rint(20.0 + 200.0 * lit + 2.0 * noise), 0, 255).astype(np.uint8)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("columns", "exposure"), [(7.3, 0.4), (21.0, 0.7)])
def test_chips_that_never_repeat_are_read(seed: int, columns: float, exposure: float) -> None:
    chips = random_chips(seed)
    read = occ.read_chips(photo_of(picture(chips, columns, exposure)))
    assert read.text in "".join(map(str, chips))
    assert len(read.chips) >= 0.8 * len(chips)
    assert read.columns_per_chip == pytest.approx(columns, rel=0.002)
    assert read.confidence > 0.8


def test_the_first_chip_starts_where_its_edge_is() -> None:
    bars = np.repeat([20, 220, 20, 20, 220, 220, 20, 220, 20, 20, 20, 220, 20], 15)
    read = occ.read_chips(photo_of(np.tile(bars.astype(np.uint8), (30, 1))))
    place = (read.start - 14.5) / read.columns_per_chip
    assert place == pytest.approx(round(place), abs=0.1)


@pytest.mark.parametrize("sliver", [2.0, 4.0, 7.0, 11.0])
@pytest.mark.parametrize("is_last", [False, True])
def test_a_panel_cut_within_a_chip_has_no_chip_of_its_own_there(
    sliver: float, is_last: bool
) -> None:
    # Beside the whole chips is the part of a bright one that the panel's rim leaves.
    edges = edges_at([10.0 - sliver, *range(30, 400, 40)], np.arange(10.0, 400, 40))
    inner = edges.where(slice(1, None))
    if is_last:
        inner, edges = (edges_at(400.0 - one.falling, 400.0 - one.rising) for one in (inner, edges))
    chips = lattice_at(inner, 1 / 20)
    assert part_between_rims(inner, chips) == slice(0, len(inner))
    kept = edges.where(part_between_rims(edges, chips))
    found = chips_between(kept, chips)
    assert kept.place.tolist() == inner.place.tolist()
    assert "".join(map(str, found[0])) in "01" * 20


def test_no_chips_are_read_from_noise() -> None:
    lines = np.random.default_rng(2).normal(120.0, 40.0, 900).cumsum() % 256
    try:
        read = occ.read_chips(photo_of(np.tile(lines.astype(np.uint8), (30, 1))))
    except occ.MatchError:
        return
    assert read.confidence < 0.5


def test_nine_of_ten_readings_that_are_nine_tenths_sure_are_right() -> None:
    read, messages = [], amount(40, 60)
    for seed in range(messages):
        sent = message(seed)
        try:
            one = occ.read_chips(sent.photo)
        except occ.MatchError:
            continue
        read.append((one.confidence, sent.is_right(one)))
    confidence, right = np.array(read, dtype=float).T
    sure = confidence >= 0.9
    assert sure.sum() > 0.5 * messages
    assert right[sure].mean() >= 0.9
    # A probability is right on average, within three deviations of a fraction of as many.
    scatter = np.sqrt(np.sum(confidence * (1.0 - confidence))) / len(right)
    assert confidence.mean() == pytest.approx(right.mean(), abs=3.0 * scatter)


CHIP = 6.19
BURST = "1110100101100110100110"


def edges_of_bursts(pause: float) -> Edges:
    """Edges of a burst sent twice, the second one so many chips after the first."""
    chips = np.array([int(chip) for chip in f"0{BURST}0"])
    steps = np.flatnonzero(np.diff(chips)) + 1
    rises = np.diff(chips)[steps - 1] > 0
    both = np.concatenate([steps, steps + len(BURST) + pause])
    noise = np.random.default_rng(3).normal(0.0, 0.05, len(both))
    return Edges(CHIP * both + noise, np.tile(rises, 2))


@pytest.mark.parametrize("pause", [3.3, 4.4])
def test_a_pause_that_is_no_whole_number_of_chips_is_the_nearest_one(pause: float) -> None:
    edges = edges_of_bursts(pause)
    moved = align_bursts(edges)
    assert moved is not edges
    lattice = find_coarsest(moved)
    assert 1.0 / lattice.frequency == pytest.approx(CHIP, rel=0.01)
    found = chips_between(moved, lattice)
    lit = BURST.rstrip("0")
    between = len(BURST) - len(lit) + round(pause)
    assert "".join(map(str, found[0])) == lit + "0" * between + lit


def test_bursts_that_are_whole_chips_apart_stay_where_they_are() -> None:
    edges = edges_of_bursts(4.0)
    assert align_bursts(edges) is edges


def test_messages_with_pauses_are_read_rightly_where_they_are_sure() -> None:
    read = []
    for seed in range(61000, 61008):
        sent = message(seed, pauses=True)
        try:
            reading = occ.read_chips(sent.photo)
        except occ.MatchError:
            continue
        if reading.confidence > 0.9:
            read.append(reading.text in sent.chips)
    assert all(read)
    assert len(read) >= 2
