"""The timing of chips in one picture: its first lattice, and closed forms of the exposure."""

from dataclasses import replace

import numpy as np
import pytest
from amount import amount
from lit_fractions import lit_fractions

import occ_model as occ
from occ_model.photo.fit.least_squares import StripeModel
from occ_model.photo.fit.timing import Timing
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.video.chip_timing import ChipLattice, ChipTiming, chip_ratios, fit_timing, noise_of
from occ_model.video.read_frame import fit_lattice

CHIPS = np.array([1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 0], dtype=np.uint8)
LENGTH = 20.0
"""Columns per chip."""


def _lit(lattice: ChipLattice, columns: int) -> np.ndarray:
    starts = lattice.phase - lattice.first + lattice.step * np.arange(columns)
    return lit_fractions(lattice.values, starts, lattice.exposure)


def _light(lattice: ChipLattice, columns: int, noise: float, seed: int) -> np.ndarray:
    """Return the light of a panel that is brighter on one side, with noise."""
    random = np.random.default_rng(seed)
    place = np.linspace(-1.0, 1.0, columns)
    fraction = _lit(lattice, columns)
    swing = 1.0 + 0.3 * place - 0.2 * place**2
    return np.asarray(
        0.1 + 0.05 * place + swing * fraction + noise * random.standard_normal(columns)
    )


def _lattice(exposure: float, seed: int, step: float = 0.0713) -> ChipLattice:
    random = np.random.default_rng(seed)
    values = random.integers(0, 2, 90, dtype=np.uint8)
    return ChipLattice(step, random.uniform(0.0, 1.0), exposure, 0, values)


def _rough(lattice: ChipLattice, seed: int) -> ChipLattice:
    shift = float(np.random.default_rng(seed).uniform(-0.4, 0.4))
    return ChipLattice(
        lattice.step * (1.0 + 1e-3), lattice.phase + shift, 0.9 * lattice.exposure, 0,
        lattice.values,
    )  # fmt: skip


def _fit(exposure: float, noise: float, seed: int) -> tuple[ChipLattice, ChipTiming]:
    lattice = _lattice(exposure, seed)
    fitted = fit_timing(_light(lattice, 1200, noise, seed), _rough(lattice, seed))
    assert fitted is not None
    return lattice, fitted


@pytest.mark.parametrize("exposure", [0.2, 0.5, 0.97, 1.8])
def test_without_noise_phase_and_step_are_exact(exposure: float) -> None:
    lattice, fitted = _fit(exposure, 1e-6, 7)
    assert fitted.middle == pytest.approx(lattice.middle(1200), abs=1e-3)
    assert fitted.lattice.step == pytest.approx(lattice.step, rel=1e-5)


def test_light_without_noise_has_errors_if_no_column_shows_the_exposure() -> None:
    for seed in range(10):
        _, fitted = _fit(0.005, 1e-7, seed)
        assert 0.0 < fitted.middle_error < np.inf
        assert 0.0 < fitted.step_error < np.inf


def test_an_exposure_shorter_than_a_column_has_an_error_that_is_not_understated() -> None:
    """With three columns per chip that see a third of it, noise alone would give a fortieth."""
    found, columns = [], 280
    for seed in range(amount(15, 60)):
        lattice = _lattice(0.1, seed, step=0.3)
        fitted = fit_timing(_light(lattice, columns, 0.003, seed), _rough(lattice, seed))
        assert fitted is not None
        found.append((fitted.middle - lattice.middle(columns)) / fitted.middle_error)
    # The true error depends on where the edges lie, and the stated one is for the worst places.
    assert float(np.sqrt(np.mean(np.square(found)))) < 1.2


def test_stated_errors_of_phase_and_step_cover_68_percent() -> None:
    found = []
    for seed in range(amount(40, 120)):
        lattice, fitted = _fit(0.5, 0.05, seed)
        found.append((fitted.middle - lattice.middle(1200)) / fitted.middle_error)
        found.append((fitted.lattice.step - lattice.step) / fitted.step_error)
    # Standard deviation of the fraction in 120 values: 4 %.
    assert np.mean(np.abs(found) < 1.0) == pytest.approx(0.68, abs=0.08)


def test_vignetting_does_not_shift_the_edges_of_all_frames_equally() -> None:
    place = np.linspace(-1.0, 1.0, 1200)
    fall = np.cos(np.arctan(0.9 * (place - 0.3))) ** 4
    found = []
    for seed in range(amount(16, 60)):
        lattice = _lattice(0.5, seed)
        fraction = _lit(lattice, 1200)
        noise = 0.01 * np.random.default_rng(seed).standard_normal(1200)
        fitted = fit_timing(fall * (0.1 + fraction) + noise, _rough(lattice, seed))
        found.append((fitted.lattice.step - lattice.step) / fitted.step_error)
    # If their errors are those of the noise alone, the mean of 30 deviates by 0.18.
    assert abs(np.mean(found)) < 0.4
    assert 0.6 < np.std(found) < 1.4


def test_a_misread_chip_is_corrected() -> None:
    lattice = _lattice(0.5, 11)
    values = lattice.values.copy()
    values[[20, 45]] ^= 1
    rough = ChipLattice(lattice.step, lattice.phase, 0.5, 0, values)
    fitted = fit_timing(_light(lattice, 1200, 0.02, 11), rough)
    inside = slice(1, 85)
    np.testing.assert_array_equal(fitted.lattice.values[inside], lattice.values[inside])
    assert ((fitted.ratios > 0.0) == (lattice.values == 1))[inside].all()


def test_chips_that_never_change_have_no_timing() -> None:
    lattice = ChipLattice(0.07, 0.2, 0.5, 0, np.ones(80, dtype=np.uint8))
    assert fit_timing(np.ones(1000), lattice) is None


def test_every_ratio_is_the_change_of_the_squared_distance_by_that_chip_alone() -> None:
    lattice = _lattice(1.6, 14, step=0.2)
    light = _light(lattice, 400, 0.8, 14)
    here, timing = _lit(lattice, 400), Timing(lattice.step, 1.6, lattice.middle(400), 1.0)
    _, swing, profile = StripeModel(light, lattice.values, None, lattice.step).levels(timing)
    found = chip_ratios(lattice, swing, light - profile)
    noise = noise_of(swing, light - profile, lattice.step)
    for chip, ratio in enumerate(found.tolist()):
        squares = []
        for value in (0, 1):
            values = lattice.values.copy()
            values[chip] = value
            fraction = _lit(replace(lattice, values=values), 400)
            residual = light - profile + swing * (here - fraction)
            squares.append(float(residual @ residual))
        # In the computed light, chips out of view equal the outermost ones.
        if 3 < chip < 80:
            assert ratio == pytest.approx((squares[0] - squares[1]) / (2.0 * noise), abs=1e-9)


def scene_of(columns_a_chip: float = LENGTH) -> Scene:
    """Return a scene of short exposures whose chips last this many columns."""
    scene = occ.load_preset("phone-136us").replace(exposure_time=1e-6)
    return scene.replace(switching_frequency=1.0 / (columns_a_chip * scene.camera.readout_time))


def signal_of(chips: np.ndarray) -> np.ndarray:
    """Return light of 90 for lit chips, and of 10 for dark ones."""
    return 10.0 + 80.0 * np.repeat(chips, int(LENGTH)).astype(float)


def make_result(chips: np.ndarray, starts: np.ndarray, threshold: float | None) -> DecodeResult:
    return DecodeResult("threshold", chips=chips, chip_starts=starts, threshold=threshold)


STARTS = LENGTH * np.arange(len(CHIPS))


def counted_thrice_more(run: slice) -> tuple[np.ndarray, np.ndarray]:
    """Count three chips too many in a run, which moves the edges beyond it."""
    inside = np.linspace(STARTS[run.start], STARTS[run.stop], 6)[:-1]
    seen = np.concatenate([STARTS[: run.start], inside, STARTS[run.stop :]])
    return np.insert(CHIPS, run.start, [1, 1, 1]), seen


def counted_twice(chip: int) -> tuple[np.ndarray, np.ndarray]:
    """Only the edge in the middle of the chip lies before its place."""
    seen = np.insert(STARTS, chip + 1, STARTS[chip] + 0.5 * LENGTH)
    return np.insert(CHIPS, chip, CHIPS[chip]), seen


@pytest.mark.parametrize(
    ("chips", "seen"),
    [
        counted_thrice_more(slice(2, 4)),
        counted_thrice_more(slice(11, 13)),
        # One chip too few: all edges beyond it deviate to one side.
        *((np.delete(CHIPS, lost), np.delete(STARTS, lost)) for lost in (12, 3)),
        counted_twice(len(CHIPS) - 2),
    ],
)
def test_miscounted_chips_do_not_change_the_length_of_a_chip(
    chips: np.ndarray, seen: np.ndarray
) -> None:
    found = fit_lattice(make_result(chips, seen, 50.0), signal_of(CHIPS), 0, scene_of())
    assert found.step == pytest.approx(1.0 / LENGTH, rel=0.01)


@pytest.mark.parametrize("threshold", [50.0, None])
def test_chips_are_read_by_the_threshold_if_there_is_one_or_else_by_the_decoder(
    threshold: float | None,
) -> None:
    # For one chip the decoder disagrees with the signal, as an equalizer may.
    said = CHIPS.copy()
    said[9:11] = 1
    result = make_result(said, STARTS, threshold)
    found = fit_lattice(result, signal_of(CHIPS), 0, scene_of())
    shown = found.values[-found.first :][: len(CHIPS)]
    np.testing.assert_array_equal(shown, said if threshold is None else CHIPS)
