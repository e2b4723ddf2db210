"""The edges of a lamp's stripes, how it blinks, and whether others blink in time with it."""

import numpy as np
import pytest

from occ_model.photo.lamps.edges import LampEdges, edges_of
from occ_model.photo.lamps.segments import LEAST_EDGES, clip_spans, progressions_of, segments_of
from occ_model.photo.lamps.shape import rectangles
from occ_model.photo.lamps.timing import LampTiming, timings_of

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


def timing_of(
    places: list[float], first_rises: bool = True, spacing: float = 20.0, *, is_code: bool = False
) -> LampTiming:
    place = np.array(places)
    rises = (np.arange(len(place)) % 2 == 0) == first_rises
    edges = LampEdges(place, rises, np.zeros(len(place)), np.full(len(place), 100.0))
    rise, fall = float(place[rises][0] % spacing), float(place[~rises][0] % spacing)
    return LampTiming(spacing, 0.01, rise, fall, is_code=is_code, off=0.0, edges=edges)


@pytest.mark.parametrize(("first_rises", "widest"), [(True, 9.0), (False, 14.0)])
def test_the_widest_bright_stripe_goes_from_a_rising_edge_to_a_falling_one(
    first_rises: bool, widest: float
) -> None:
    assert timing_of([0.0, 8.0, 20.0, 29.0, 43.0], first_rises).longest_stripe == widest


def test_without_a_whole_stripe_the_longest_is_as_wide_as_the_spacing() -> None:
    assert timing_of([5.0, 17.0], False).longest_stripe == 20.0


PULSES = [0.0, 8.0, 20.0, 28.0, 40.0, 48.0, 60.0, 68.0]


@pytest.mark.parametrize(
    ("later", "longer", "agrees"),
    [(0.0, 0.0, True), (40.0, 0.0, True), (0.3, 0.0, True), (6.0, 0.0, False), (0.0, 1.0, False)],
)
def test_lamps_agree_whose_edges_lie_on_the_same_lattices(
    later: float, longer: float, agrees: bool
) -> None:
    spacing = 20.0 + longer
    other = [later + place * spacing / 20.0 for place in PULSES]
    assert timing_of(PULSES).agrees(timing_of(other, spacing=spacing)) == agrees
    assert timing_of(PULSES).chip == 10.0
    assert timing_of(PULSES, is_code=True).chip == 20.0


def test_a_part_of_a_lamp_whose_chips_alternate_agrees_with_its_code() -> None:
    code = timing_of([0.0, 10.0, 20.0, 40.0, 50.0, 60.0], spacing=10.0, is_code=True)
    pulses = timing_of([100.0, 110.0, 120.0, 130.0, 140.0, 150.0], spacing=20.0)
    assert code.agrees(pulses)
    assert not pulses.agrees(code)


@pytest.mark.parametrize("shift", [-0.4, 0.0, 0.5])
def test_a_chip_is_the_longest_that_all_distances_are_multiples_of(shift: float) -> None:
    chips = np.tile([int(one) for one in "1110010110100101"], 4)
    steps = np.diff(chips)
    at = np.flatnonzero(steps)
    rises = steps[at] > 0
    place = np.asarray(12.0 * (at + np.where(rises, 0.0, shift)), dtype=np.float64)
    (one,) = segments_of(LampEdges(place, rises, np.zeros(len(at)), np.ones(len(at))), 0)
    assert (one.period, one.chip) == (None, pytest.approx(12.0, rel=0.01))


def test_parts_of_progressions_are_kept_that_have_edges_enough() -> None:
    least = LEAST_EDGES
    parts = [(0, 10, 20.0), (8, 30, 25.0)]
    assert clip_spans(parts, 10 - least, 40) == [(10 - least, 10, 20.0), (8, 30, 25.0)]
    assert clip_spans(parts, 11 - least, 40) == [(8, 30, 25.0)]
    assert clip_spans(parts, 0, 8 + least) == [(0, 10, 20.0), (8, 8 + least, 25.0)]


def test_progressions_are_found_whose_every_second_edge_is_a_period_farther() -> None:
    one = [0.0, 8.0, 20.0, 28.0, 40.0, 48.0, 60.0]
    other = [75.0, 85.0, 105.0, 115.0, 135.0, 145.0]
    found = progressions_of(np.array([*one, *other]), 1.0)
    assert found[0] == (0, 7, pytest.approx(20.0))
    assert (7, 13, pytest.approx(30.0)) in found


def test_a_lamps_rectangle_has_every_column_that_its_edges_touch() -> None:
    """Edges are smoothed over neighbouring strips, and end at the sides of the photo."""
    bounds = np.array([0, 10, 20, 30, 40])
    sides = (3.2, 9.4)
    found = rectangles({1: sides, 2: sides}, bounds, 50)
    assert found[:, :2].tolist() == [[10, 20], [20, 30]]
    for left, right in found[:, 2:].tolist():
        assert (left, right - 1) == (3, 10)
    (rim,) = rectangles({0: (-2.5, 60.0)}, bounds, 50)
    assert rim.tolist() == [0, 10, 0, 50]
    assert rectangles({}, bounds, 50).shape == (0, 4)
    # A strip in which no lamp is seen gets the edges of those before and after it.
    gap = rectangles({0: sides, 2: sides}, bounds, 50)
    assert gap[1].tolist() == [10, 20, 3, 11]
