"""Depth of the bars of a lamp with slow edges, against exact fractions."""

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

import occ_model as occ
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import light_depth

_PHONE = occ.load_preset("phone-136us").replace(illuminance=0.0)


def _second_integral(chips: list[int], place: Fraction) -> Fraction:
    """Return the light up to a place, integrated once more; places may be below 0."""
    period, total = len(chips), sum(chips)
    of_period = sum(
        (Fraction(2 * (period - k) - 1, 2) * lit for k, lit in enumerate(chips)), Fraction()
    )
    periods, rest = divmod(place, period)
    whole = Fraction(periods)
    done = int(rest)
    part = rest - done
    lit = sum(chips[:done])
    inside = sum(
        (Fraction(2 * (done - k) - 1, 2) * lit for k, lit in enumerate(chips[:done])), Fraction()
    )
    inside += lit * part + chips[done] * part * part / 2
    before = whole * of_period + total * period * whole * (whole - 1) / 2
    return before + whole * total * rest + inside


def _reference(chips: list[int], exposure: Fraction, edge: Fraction) -> tuple[Fraction, Fraction]:
    """Return peak to peak and mean square over the mean, of both: a second difference."""
    period, lit = len(chips), sum(chips)
    mean = Fraction(lit, period) * exposure

    def light(start: Fraction) -> Fraction:
        ends = (start + exposure, start, start + exposure - edge, start - edge)
        far, near, far_before, near_before = (_second_integral(chips, end) for end in ends)
        return (far - near - far_before + near_before) / edge - mean

    shifts = (Fraction(0), edge, -exposure, edge - exposure)
    places = sorted({(k + shift) % period for k in range(period) for shift in shifts})
    found: list[Fraction] = []
    square = Fraction(0)
    for start, end in pairwise([*places, places[0] + period]):
        first, middle, last = light(start), light((start + end) / 2), light(end)
        bend, slope = 2 * (first + last) - 4 * middle, 4 * middle - 3 * first - last
        found += [first, last]
        if bend and 0 < -slope / (2 * bend) < 1:
            found.append(first - slope * slope / (4 * bend))
        terms = (first, slope, bend)
        square += (end - start) * sum(
            (a * b / (i + j + 1) for i, a in enumerate(terms) for j, b in enumerate(terms)),
            Fraction(0),
        )
    return (max(found) - min(found)) / mean, square / period / mean**2


def _scene(random: np.random.Generator) -> Scene:
    chips = random.integers(0, 2, int(random.integers(2, 25)))
    chips[:2] = 1, 0
    frequency = float(10.0 ** random.uniform(2.5, 5.0))
    return _PHONE.replace(
        pattern="".join(map(str, chips)), switching_frequency=frequency,
        exposure_time=float(10.0 ** random.uniform(-2.0, 2.5)) / frequency,
        edge_time=min(1e-3, float(10.0 ** random.uniform(-4.0, 0.7)) / frequency),
    )  # fmt: skip


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(seed, marks=pytest.mark.whole) for seed in (1, 2))]
)
def test_the_depth_with_slow_edges_is_exact_to_1e_13_of_the_mean(seed: int) -> None:
    random = np.random.default_rng([24, seed])
    worst = 0.0
    for _ in range(20):
        scene = _scene(random)
        sent = scene.transmitter
        frequency = Fraction(sent.switching_frequency)
        peak, square = _reference(
            [int(chip) for chip in sent.pattern],
            Fraction(scene.camera.exposure_time) * frequency, Fraction(sent.edge_time) * frequency,
        )  # fmt: skip
        found = light_depth(scene)
        worst = max(worst, abs(found.peak_to_peak - peak), abs(found.rms - math.sqrt(square)))
    assert worst < 1e-13
