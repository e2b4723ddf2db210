"""Depth of the bars against references of its own, and against pictures with noise."""

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.camera.photometry import luminance_of
from occ_model.results.bands import Depth
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import light_depth

_PHONE = occ.load_preset("phone-136us")


def _pulses(chips: int, lit: int, frequency: float, exposure: float, **others: float) -> Scene:
    """Return a scene in the dark whose lamp is lit for some chips of each period."""
    return _PHONE.replace(
        pattern="1" * lit + "0" * (chips - lit),
        switching_frequency=chips * frequency,
        exposure_time=exposure,
        **{"illuminance": 0.0, **others},
    )


@pytest.mark.parametrize(("frequency", "periods"), [(100.0, 0.3), (100.0, 1.0), (120.0, 2.4)])
def test_a_flicker_of_the_surroundings_alone_is_a_sine_behind_the_exposure(
    frequency: float, periods: float
) -> None:
    scene = _PHONE.replace(
        luminance=0.0, flicker_depth=0.4, flicker_frequency=frequency,
        exposure_time=periods / frequency, iso=1.0,
    )  # fmt: skip
    found = light_depth(scene)
    left = 0.4 * abs(math.sin(math.pi * periods) / (math.pi * periods))
    assert found.peak_to_peak == pytest.approx(2.0 * left, rel=1e-9, abs=1e-15)
    assert found.rms == pytest.approx(left / math.sqrt(2.0), rel=1e-9, abs=1e-15)


def test_code_and_flicker_add_up_where_they_meet_at_all_phases() -> None:
    scene = _PHONE.replace(flicker_depth=0.5, luminance=30.0, exposure_time=3e-4, iso=3200.0)
    both = occ.band_depth(scene)
    many = {"columns": 100_000, "readout_time": 24 / 10e3 / 100_000, "flicker_depth": 0.0}
    profile = occ.column_profile(scene.replace(**many))
    steady = occ.band_depth(scene.replace(flicker_depth=0.0))
    assert both.peak_to_peak > steady.peak_to_peak
    assert steady.pixel.rms == pytest.approx(profile.std() / profile.mean(), rel=1e-3)
    assert steady.pixel.peak_to_peak == pytest.approx(np.ptp(profile) / profile.mean(), rel=1e-3)


@pytest.mark.parametrize("averaging", ["light", "pixel-value"])
@pytest.mark.parametrize("seed", range(amount(3, 6)))
def test_pictures_with_noise_have_bars_of_this_depth(seed: int, averaging: str) -> None:
    rng = np.random.default_rng(seed)
    chips = int(rng.integers(2, 9))
    scene = _pulses(
        chips, int(rng.integers(1, chips)), float(rng.uniform(300.0, 1500.0)),
        float(10.0 ** rng.uniform(-4.3, -2.3)), illuminance=290.0, columns=3000, rows=600,
        distance=0.3, luminance=300.0,
    ).replace(averaging=averaging)  # fmt: skip
    brightest = float(np.max(occ.column_profile(scene)))
    scene = scene.replace(iso=max(1.0, 100.0 * (200.0 / brightest) ** 2.22))
    found = occ.band_depth(scene)
    image = occ.render(scene, tolerance=0.0, seed=seed).camera_image[200:400, 800:2200]
    rows, profile = len(image), image.mean(axis=0)
    # What noise leaves in the mean of a column, and in the extremes of as many.
    noise = float(image.std(axis=0).mean()) / math.sqrt(rows) + 0.1
    levels = profile.mean()
    assert np.ptp(profile) / levels == pytest.approx(
        found.pixel.peak_to_peak, abs=9 * noise / levels
    )
    assert profile.std() / levels == pytest.approx(
        found.pixel.rms, abs=2 * noise / levels, rel=0.02
    )
    if averaging == "light":
        light = luminance_of(profile, scene.camera)
        spread = (
            9
            * noise
            * float(np.ptp(luminance_of(np.add(profile, [[-0.5], [0.5]]), scene.camera), 0).max())
        )
        assert np.ptp(light) == pytest.approx(
            found.peak_to_peak * light.mean(), abs=spread, rel=0.02
        )


def test_what_is_saturated_shows_no_bars() -> None:
    scene = _PHONE.replace(iso=1e6, luminance=1e6, illuminance=1e6, exposure_time=1.37e-4)
    found = occ.band_depth(scene)
    assert found.peak_to_peak > 0.5
    assert found.pixel.peak_to_peak == 0.0
    assert found.pixel.rms < 1e-12
    assert not found.is_visible


def test_without_light_there_are_no_bars() -> None:
    found = occ.band_depth(_PHONE.replace(luminance=0.0, illuminance=0.0))
    assert (found.light, found.pixel, found.is_visible) == (Depth(0.0, 0.0), Depth(0.0, 0.0), False)


@pytest.mark.parametrize(("frequency", "period"), [(1000.0, 125.0), (124_000.0, 125.0)])
def test_the_period_is_that_which_the_columns_show(frequency: float, period: float) -> None:
    # 8 us a column: 125,000 columns a second, so that 124 kHz looks like 1 kHz.
    found = occ.band_depth(_pulses(2, 1, frequency, 0.3 / frequency, readout_time=8e-6))
    assert found.frequency == pytest.approx(frequency)
    assert found.period == pytest.approx(period, rel=1e-9)


def test_finer_bars_need_more_contrast_to_be_seen() -> None:
    thresholds = [
        occ.band_depth(_pulses(2, 1, frequency, 3e-6, readout_time=8e-6)).threshold
        for frequency in (300.0, 10e3, 30e3, 60e3)
    ]
    assert thresholds[0] == pytest.approx(0.01, rel=1e-3)
    assert thresholds == sorted(thresholds)
    assert thresholds[-1] > 0.05


_DARK = occ.load_preset("phone-136us").replace(illuminance=0.0)


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
    return _DARK.replace(
        pattern="".join(map(str, chips)), switching_frequency=frequency,
        exposure_time=float(10.0 ** random.uniform(-2.0, 2.5)) / frequency,
        edge_time=min(1e-3, float(10.0 ** random.uniform(-4.0, 0.7)) / frequency),
    )  # fmt: skip


def test_the_depth_with_slow_edges_is_exact_to_1e_13_of_the_mean() -> None:
    random = np.random.default_rng([24, 0])
    worst = 0.0
    for _ in range(amount(3, 20)):
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
