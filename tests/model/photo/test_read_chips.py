"""The chips in view are read without a period, up to their number and their order."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from photo_world.messages import message as simulated_message
from simulated_photos import photo_of

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.photo.chips.edges import Edges, edges_of
from occ_model.photo.chips.lattice import (
    certainty,
    chips_between,
    coarsest,
    lattice_at,
    without_rims,
)
from occ_model.photo.fit.timing import Timing
from occ_model.transmitter.waveform import Waveform


def message(seed: int, chips: int = 60) -> ByteArray:
    """Draw chips that repeat nowhere."""
    return np.random.default_rng(seed).integers(0, 2, chips).astype(np.uint8)


def picture(chips: ByteArray, columns: float, exposure: float, gamma: float = 1.0) -> ByteArray:
    """Photograph chips once, with noise."""
    timing = Timing(1.0 / columns, exposure, 0.5 * len(chips), gamma)
    lit = timing.lit_fraction(Waveform(chips), int(0.95 * len(chips) * columns))
    values = 20.0 + 200.0 * lit ** (1.0 / gamma)
    noise = np.random.default_rng(1).standard_normal((40, len(lit)))
    return np.clip(np.rint(values + 2.0 * noise), 0, 255).astype(np.uint8)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("columns", "exposure"), [(7.3, 0.4), (21.0, 0.7)])
def test_chips_that_never_repeat_are_read(seed: int, columns: float, exposure: float) -> None:
    chips = message(seed)
    read = occ.read_chips(photo_of(picture(chips, columns, exposure)))
    assert read.text in "".join(map(str, chips))
    assert len(read.chips) >= 0.8 * len(chips)
    assert read.columns_per_chip == pytest.approx(columns, rel=0.002)
    assert read.confidence > 0.8


def test_gamma_shifts_the_edges_and_not_the_chips() -> None:
    chips = message(5)
    read = occ.read_chips(photo_of(picture(chips, 12.0, 0.8, gamma=2.2)))
    assert read.text in "".join(map(str, chips))


def test_the_first_chip_starts_where_its_edge_is() -> None:
    bars = np.repeat([20, 220, 20, 20, 220, 220, 20, 220, 20, 20, 20, 220, 20], 15)
    read = occ.read_chips(photo_of(np.tile(bars.astype(np.uint8), (30, 1))))
    place = (read.start - 14.5) / read.columns_per_chip
    assert place == pytest.approx(round(place), abs=0.1)


def test_edges_that_scatter_about_their_lattice_are_less_certain() -> None:
    random = np.random.default_rng(2)
    rising, falling = np.arange(30.0, 1000, 40), np.arange(50.0, 1000, 40)
    lattice = lattice_at(Edges(rising, falling), 1 / 20)
    found = []
    for spread in (0.2, 3.5, 5.0):
        moved = [kind + spread * random.normal(size=kind.size) for kind in (rising, falling)]
        found.append(certainty(Edges(*moved), lattice))
    assert 1.0 >= found[0] > found[1] > found[2]
    assert found[0] > 0.99
    # Of 49 edges, each with a deviation of a quarter of a chip, two are misplaced in the mean.
    assert found[2] < 0.2


@pytest.mark.parametrize("sliver", [2.0, 4.0, 7.0, 11.0])
@pytest.mark.parametrize("is_last", [False, True])
def test_a_panel_cut_within_a_chip_has_no_chip_of_its_own_there(
    sliver: float, is_last: bool
) -> None:
    # Next to the whole chips stands what the panel's rim leaves of a bright one.
    chips = lattice_at(Edges(np.arange(30.0, 400, 40), np.arange(50.0, 400, 40)), 1 / 20)
    rim = 10.0 - sliver
    edges = Edges(np.array([rim, *range(30, 400, 40)]), np.arange(10.0, 400, 40))
    if is_last:
        edges = Edges(400.0 - edges.falling[::-1], 400.0 - edges.rising[::-1])
        chips = lattice_at(edges.within(0.0, 391.0), 1 / 20)
    kept = without_rims(edges, chips)
    found = chips_between(kept, chips)
    assert kept.count == edges.count - 1
    assert "".join(map(str, found[0])) in "01" * 20


def test_no_chips_are_read_from_noise() -> None:
    lines = np.random.default_rng(2).normal(120.0, 40.0, 900).cumsum() % 256
    try:
        read = occ.read_chips(photo_of(np.tile(lines.astype(np.uint8), (30, 1))))
    except occ.MatchError:
        return
    assert read.confidence < 0.5


@given(shift=st.floats(0.0, 0.3), frequency=st.floats(0.05, 0.4), start=st.floats(0.0, 1.0))
def test_edges_of_either_kind_may_be_shifted(shift: float, frequency: float, start: float) -> None:
    chips = message(3)
    changes = np.flatnonzero(np.diff(chips)) + 1.0
    rising = chips[changes.astype(int)] == 1
    places = (changes + start + shift * ~rising) / frequency
    profile_edges = type(edges_of(np.array([0.0, 1.0])))(places[rising], places[~rising])
    found = lattice_at(profile_edges, frequency)
    assert found.coherence == pytest.approx(1.0, abs=1e-6)
    assert found.falling - found.rising == pytest.approx(shift, abs=1e-6)
    coarse = coarsest(profile_edges)
    assert coarse.frequency == pytest.approx(frequency, rel=0.01)


@pytest.mark.parametrize(
    "seeds", [range(60), pytest.param(range(60, 120), marks=pytest.mark.whole)],
    ids=["sample", "whole"],
)  # fmt: skip
def test_nine_of_ten_readings_that_are_nine_tenths_sure_are_right(seeds: range) -> None:
    read = []
    for seed in seeds:
        sent = simulated_message(seed)
        try:
            one = occ.read_chips(sent.photo)
        except occ.MatchError:
            continue
        read.append((one.confidence, sent.is_right(one)))
    confidence, right = np.array(read, dtype=float).T
    sure = confidence >= 0.9
    assert sure.sum() > 0.5 * len(seeds)
    assert right[sure].mean() >= 0.9
    # A probability is right on average, within three deviations of a share of as many.
    scatter = np.sqrt(right.mean() * (1.0 - right.mean()) / len(right))
    assert confidence.mean() == pytest.approx(right.mean(), abs=3.0 * scatter)
