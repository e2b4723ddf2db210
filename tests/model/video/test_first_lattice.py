"""The lattice that a decoder's chips are put on before their timing is fitted."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.video.first_lattice import first_lattice

CHIPS = np.array([1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 0], dtype=np.uint8)
LENGTH = 20.0
"""Columns a chip."""


def scene_of(columns_a_chip: float = LENGTH) -> Scene:
    """A scene of short exposures whose chips last so many columns."""
    scene = occ.load_preset("phone-136us").replace(exposure_time=1e-6)
    return scene.replace(switching_frequency=1.0 / (columns_a_chip * scene.camera.readout_time))


def signal_of(chips: np.ndarray) -> np.ndarray:
    """Light of 90 where a chip is lit, and 10 where none is."""
    return 10.0 + 80.0 * np.repeat(chips, int(LENGTH)).astype(float)


def decoded(chips: np.ndarray, starts: np.ndarray, threshold: float | None) -> DecodeResult:
    return DecodeResult("threshold", chips=chips, chip_starts=starts, threshold=threshold)


@pytest.mark.parametrize("side", [0, 1])
def test_miscounted_chips_do_not_change_the_length_of_a_chip(side: int) -> None:
    # Two chips of the first or of the last run were taken for more: the edges past them move.
    starts = LENGTH * np.arange(len(CHIPS))
    run = slice(2, 4) if side == 0 else slice(11, 13)
    chips = np.insert(CHIPS, run.start, [1, 1, 1])
    inside = np.linspace(starts[run.start], starts[run.stop], 6)[:-1]
    seen = np.concatenate([starts[: run.start], inside, starts[run.stop :]])
    signal = signal_of(CHIPS)
    found = first_lattice(decoded(chips, seen, 50.0), signal, 0, scene_of())
    assert found.step == pytest.approx(1.0 / LENGTH, rel=0.01)


def test_an_edge_far_before_its_place_shows_a_miscount_as_well() -> None:
    # One chip too few in the last run but one: only the last edges lie off, and all to one side.
    starts = LENGTH * np.arange(len(CHIPS))
    for lost in (12, 3):
        chips, seen = np.delete(CHIPS, lost), np.delete(starts, lost)
        found = first_lattice(decoded(chips, seen, 50.0), signal_of(CHIPS), 0, scene_of())
        assert found.step == pytest.approx(1.0 / LENGTH, rel=0.01)


def test_a_chip_that_was_counted_twice_before_the_last_edge_is_found() -> None:
    # This edge alone lies off, before its place; all others lie a little behind theirs.
    starts = LENGTH * np.arange(len(CHIPS))
    last = len(CHIPS) - 2
    chips = np.insert(CHIPS, last, CHIPS[last])
    seen = np.insert(starts, last + 1, starts[last] + 0.5 * LENGTH)
    found = first_lattice(decoded(chips, seen, 50.0), signal_of(CHIPS), 0, scene_of())
    assert found.step == pytest.approx(1.0 / LENGTH, rel=0.01)


@pytest.mark.parametrize("threshold", [50.0, None])
def test_chips_are_those_of_the_threshold_or_else_of_the_decoder(threshold: float | None) -> None:
    # The decoder says otherwise of one chip than the signal: an equalizer may.
    said = CHIPS.copy()
    said[9:11] = 1
    result = decoded(said, LENGTH * np.arange(len(said)), threshold)
    found = first_lattice(result, signal_of(CHIPS), 0, scene_of())
    shown = found.values[-found.first :][: len(CHIPS)]
    np.testing.assert_array_equal(shown, said if threshold is None else CHIPS)
