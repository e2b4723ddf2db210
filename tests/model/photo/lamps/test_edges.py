"""The edges of stripes in a lamp whose light is uneven, and beside which light is scattered."""

import numpy as np

from occ_model.photo.lamps.edges import edges_of
from occ_model.photo.lamps.timing import timings_of

PERIOD = 24.0


def ramps(columns: int, exposure: float) -> np.ndarray:
    """Share of each column's exposure in which a square wave is on."""
    fine = (np.arange(16 * columns) / 16 / PERIOD) % 1.0 < 0.5
    window = np.ones(int(16 * exposure)) / int(16 * exposure)
    return np.convolve(fine, window, mode="same").reshape(-1, 16).mean(axis=1)


def test_light_that_falls_within_a_lamp_does_not_move_the_edges_of_its_stripes() -> None:
    columns = np.arange(240)
    wave = ramps(240, 0.9 * PERIOD / 2)
    even, hot = 200.0 * wave, 200.0 * wave * np.exp(-(((columns - 120) / 90.0) ** 2))
    expected, found = edges_of(even).place, edges_of(hot).place
    inner = found[(found > 40.0) & (found < 195.0)]
    off = np.abs(inner[:, None] - expected).min(axis=1)
    assert len(inner) == 13
    # Levels half-way up each step alone put edges up to a column off.
    assert off.max() < 0.25


def test_faint_stripes_of_a_bright_lamp_are_no_ringing_beside_its_rim() -> None:
    profile = np.full(300, 10.0)
    profile[60:240] = 200.0 + 25.0 * (ramps(300, 6.0)[60:240] - 0.5)
    place = edges_of(profile).place
    inner = place[(place > 90.0) & (place < 220.0)]
    np.testing.assert_allclose(np.diff(inner), PERIOD / 2, atol=0.2)
    assert len(inner) >= 10


def test_one_overshoot_beside_a_rim_is_no_stripe() -> None:
    profile = np.full(300, 10.0)
    profile[60:240] = 200.0
    profile[62:66] = 215.0
    assert len(edges_of(profile)) == 2


def test_jitter_of_a_pulse_makes_no_code_of_it() -> None:
    places = np.arange(16) * PERIOD / 2 + 0.5 * np.array([1, -1, 0, 1] * 4)
    rises = np.arange(16) % 2 == 0
    profile = np.full(16 * 12 + 40, 5.0)
    for begin, end in zip(places[rises] + 20, places[~rises] + 20, strict=True):
        columns = np.arange(len(profile))
        profile += 200.0 * np.clip(np.minimum(columns - begin + 0.5, end - columns + 0.5), 0, 1)
    edges = edges_of(profile)
    (timing,) = timings_of(edges, np.ones(len(edges)), codes=False)
    assert not timing.is_code
    assert abs(timing.spacing - PERIOD) < 0.1
