"""The frequency of a light that is bright in some frames and dark in others."""

import numpy as np
import pytest
from amount import amount

from occ_model.arrays import FloatArray
from occ_model.video.blinking import fit_blinking


def levels_of(
    times: FloatArray, frequency: float, duty: float, phase: float, exposure: float
) -> FloatArray:
    """Return the mean level of frames that are exposed as a whole."""
    inside = times[:, None] + np.linspace(0.0, exposure, 40)
    return np.asarray(np.mean(np.mod(inside * frequency + phase, 1.0) < duty, axis=1))


def test_the_error_of_a_blinking_light_holds_also_where_frames_see_the_same_of_each_cycle() -> None:
    random = np.random.default_rng(1)
    off, found = [], 0
    for _ in range(amount(60, 600)):
        rate, count = float(random.choice([25.0, 29.97, 30.0, 60.0])), int(random.integers(30, 300))
        frequency = float(random.uniform(max(0.5, 5.0 * rate / count), 0.4 * rate))
        times = np.arange(count) / rate
        levels = levels_of(
            times, frequency, float(random.uniform(0.3, 0.7)), float(random.random()),
            float(random.uniform(0.05, 0.9)) / rate,
        )  # fmt: skip
        blinking = fit_blinking(times, levels + 0.01 * random.standard_normal(count))
        if blinking is not None:
            found += 1
            off.append(abs(blinking.value - frequency) / blinking.error)
    assert found > 0.85 * amount(60, 600)
    assert max(off) < 4.5
    assert np.mean(np.array(off) < 1.0) > 0.6


def test_five_hertz_in_thirty_frames_a_second_are_five_and_not_quite_exact() -> None:
    blinking = fit_blinking(np.arange(60) / 30.0, np.tile([30.0, 200.0], 10).repeat(3))
    assert blinking.value == pytest.approx(5.0)
    assert 0.01 < blinking.error < 0.1


def test_irregular_or_few_changes_have_no_frequency() -> None:
    random = np.random.default_rng(2)
    times = np.arange(90) / 30.0
    assert fit_blinking(times, random.integers(0, 2, 30).astype(np.float64).repeat(3)) is None
    assert fit_blinking(times, (times > 1.0).astype(np.float64)) is None
