"""A residual that still repeats makes a match doubtful; numbers beyond limits are told apart."""

import re

import numpy as np
import pytest
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.evidence.doubts import strongest_line, told_apart

READOUT, LAMP, MAINS = 63.1e-6, 1920.0, 120.0
COLUMNS = 3000


def dimmed_lamp_on_the_mains() -> occ.Photo:
    """Draw a lamp dimmed at 1920 Hz whose brightness follows the mains, exposed for four cycles.

    The exposure averages the cycles nearly away, and the mains' ripple is left: 132 columns long,
    it looks like the square wave of a lamp photographed at 3.9 us a line.
    """
    random = np.random.default_rng(5)
    exposure, moment = 2.05e-3, 2e-6
    times = np.arange(0.0, COLUMNS * READOUT + exposure, moment)
    light = (1.0 + 0.4 * np.sin(2.0 * np.pi * MAINS * times)) * ((times * LAMP) % 1.0 < 0.5)
    integral = np.concatenate([[0.0], np.cumsum(light)])
    begin = np.arange(COLUMNS) * READOUT
    ends = np.arange(len(integral)) * moment
    lit = np.interp(begin + exposure, ends, integral) - np.interp(begin, ends, integral)
    rows = np.repeat(0.6 * (lit / lit.max())[None], 120, axis=0)
    rows = random.poisson(3000.0 * rows) / 3000.0
    return photo_of(np.rint(255.0 * rows ** (1.0 / 2.22)).astype(np.uint8))


@pytest.mark.whole
def test_mains_ripple_taken_for_the_lamp_is_doubted() -> None:
    told = occ.load_preset("phone-68us").replace(
        pattern="10", switching_frequency=2.0 * LAMP, readout_time=1e-6
    )
    match = occ.match_photo(dimmed_lamp_on_the_mains(), told, sent="scene")
    assert match.readout_time < 0.1 * READOUT, "the ripple was not taken for the lamp"
    assert match.verdict == "doubtful"
    named = re.search(r"repeats after ([\d.]+) columns", " ".join(match.reasons))
    assert float(named[1]) == pytest.approx(1.0 / (LAMP * READOUT), rel=0.01)


@pytest.mark.parametrize("amplitude", [0.03, 0.1])
def test_a_line_in_noise_has_its_period_and_amplitude(amplitude: float) -> None:
    random, place = np.random.default_rng(3), np.arange(1500)
    wave = 100.0 * amplitude * np.sin(2.0 * np.pi * place / 12.5)
    line = strongest_line(wave + random.standard_normal(1500), np.full(1500, 100.0), 97.0, 10)
    assert line.period == pytest.approx(12.5, rel=0.01)
    assert line.amplitude == pytest.approx(amplitude, rel=0.1)
    assert line.above_noise > 50.0
    assert line.fraction > 0.15


def test_noise_has_no_line_and_a_patterns_own_are_left_out() -> None:
    random, place = np.random.default_rng(4), np.arange(1500)
    noise, swing = random.standard_normal(1500), np.full(1500, 100.0)
    only_noise = strongest_line(noise, swing, 97.0, 10)
    own = strongest_line(noise + 9.0 * np.sin(2.0 * np.pi * place / 9.7), swing, 97.0, 10)
    of_three_harmonics = strongest_line(noise, swing, 6.0, 2)
    for line in (only_noise, own, of_three_harmonics):
        assert line.above_noise < 50.0


@pytest.mark.parametrize("chip", [3.87, 3.98, 4.26])
def test_sharp_edges_between_columns_leave_no_single_line(chip: float) -> None:
    """Harmonics of more than half a cycle a column are folded to others by the sampling."""
    chips, columns = np.array([1, 1, 0, 1, 0, 0, 0, 1, 0, 1]), 1500
    seen = [
        chips[((np.arange(columns) + late) / chip % 10).astype(int)].astype(float)
        for late in (0.0, 0.3)
    ]
    noise = np.random.default_rng(6).standard_normal(columns)
    residual = 100.0 * (seen[1] - seen[0]) + noise
    line = strongest_line(residual, np.full(columns, 100.0), 10 * chip, 10)
    assert line.fraction < 0.15


@pytest.mark.parametrize(
    ("value", "limit", "texts"),
    [
        (10.04, 3.0, ("10.0", "3.0")),
        (3.54, 3.52, ("3.54", "3.52")),
        (3.500_04, 3.5, ("3.50004", "3.50000")),
    ],
)
def test_a_number_and_its_limit_are_written_apart(
    value: float, limit: float, texts: tuple[str, str]
) -> None:
    assert told_apart(value, limit) == texts
