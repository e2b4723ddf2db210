"""Depth of the bars against references of its own, and against pictures with noise."""

import math
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from amount import amount
from hard_cases.references import ExactTimes

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.camera.photometry import luminance_of
from occ_model.light.sent import light_period
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


@pytest.mark.parametrize("edge", [0.0, 0.7e-3])
@pytest.mark.parametrize(
    "light",
    [{"light": "lamp", "lamp_frequency": 239.0, "duty": 0.3, "depth": 0.8},
     {"light": "mains", "mains_depth": 0.4},
     {"light": "pulses", "pulse_frequency": 90.0, "pulse_length": 2e-3},
     {"light": "waveform", "levels": "0 2 1 3 3 / 3", "switching_frequency": 900.0},
     {"light": "waveform", "waveform_file": "0,0.2\n0.003,1\n0.004,0.5\n0.009\n"}],
)  # fmt: skip
def test_columns_that_start_all_over_the_period_show_the_whole_depth_of_any_light(
    light: dict[str, Any], edge: float
) -> None:
    for exposure in (0.3e-3, 2.7e-3, 31.3e-3):
        scene = _PHONE.replace(**light, edge_time=edge, exposure_time=exposure, columns=20_000)
        period = float(light_period(scene.transmitter))
        found = occ.band_depth(scene.replace(readout_time=7.0 * period / 20_000))
        assert found.columns.peak_to_peak == pytest.approx(found.peak_to_peak, rel=1e-3)
        assert found.columns.rms == pytest.approx(found.rms, rel=1e-3)
        assert found.frequency * period == pytest.approx(round(found.frequency * period), rel=1e-9)


def test_the_bars_of_a_lamp_on_the_mains_follow_the_sine_behind_exposure_and_edges() -> None:
    scene = _PHONE.replace(
        light="mains", mains_frequency=60.0, mains_depth=0.5, exposure_time=3e-3, edge_time=2e-3,
        illuminance=0.0,
    )  # fmt: skip
    left = 0.5 * abs(np.sinc(120.0 * 3e-3) * np.sinc(120.0 * 2e-3))
    assert light_depth(scene).peak_to_peak == pytest.approx(2.0 * left, rel=1e-12)
    assert light_depth(scene.replace(exposure_time=1 / 120)).peak_to_peak < 1e-15
    assert occ.band_depth(scene).frequency == 120.0


def test_code_and_flicker_add_up_where_they_meet_at_all_phases() -> None:
    scene = _PHONE.replace(flicker_depth=0.5, luminance=30.0, exposure_time=3e-4, iso=3200.0)
    both = occ.band_depth(scene)
    steady = occ.band_depth(scene.replace(flicker_depth=0.0))
    as_bright = 30.0 * float(occ.packet(scene).mean())
    flicker = occ.band_depth(scene.replace(pattern="1", luminance=as_bright))
    assert both.peak_to_peak == pytest.approx(steady.peak_to_peak + flicker.peak_to_peak)


@pytest.mark.parametrize("start_time", [0.0, 0.0123])
def test_the_pixel_values_are_those_of_the_scene_s_own_columns(start_time: float) -> None:
    scene = _PHONE.replace(exposure_time=3e-4, start_time=start_time, columns=100)
    profile = occ.column_profile(scene)
    found = occ.band_depth(scene).pixel
    assert found.rms == pytest.approx(profile.std() / profile.mean(), rel=1e-12)
    assert found.peak_to_peak == pytest.approx(np.ptp(profile) / profile.mean(), rel=1e-12)


@pytest.mark.parametrize("averaging", ["light", "pixel-value"])
@pytest.mark.parametrize("seed", range(amount(3, 6)))
def test_pictures_with_little_noise_have_bars_of_this_depth(seed: int, averaging: str) -> None:
    rng = np.random.default_rng(seed)
    chips = int(rng.integers(2, 9))
    scene = _pulses(
        chips, int(rng.integers(1, chips)), float(rng.uniform(300.0, 1500.0)),
        float(10.0 ** rng.uniform(-4.3, -2.3)), illuminance=290.0, columns=3000, rows=600,
        distance=0.3, luminance=300.0, pixel_pitch=1e-5, full_well=1e6,
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


def test_of_a_lamp_that_blinks_at_the_line_rate_the_columns_see_nothing() -> None:
    scene = _PHONE.replace(
        pattern="10", switching_frequency=64e3, readout_time=31.25e-6, exposure_time=10e-6
    )
    found = occ.band_depth(scene)
    assert np.ptp(occ.column_profile(scene)) < 1e-9
    assert found.peak_to_peak > 1.9  # of another start
    assert found.columns.peak_to_peak < 1e-12
    assert (found.is_visible, found.period, found.frequency) == (False, math.inf, 0.0)
    assert "same phase" in found.sentence
    beside = occ.band_depth(scene.replace(switching_frequency=64.2e3))
    assert (beside.is_visible, beside.hidden) == (True, "")
    assert beside.period == pytest.approx(320.0)


@pytest.mark.parametrize(
    "light",
    [{"light": "mains", "mains_depth": 0.008, "edge_time": 3e-3},
     {"light": "lamp", "lamp_frequency": 200.0, "duty": 0.5, "depth": 0.008}],
)  # fmt: skip
def test_hidden_bars_are_those_that_columns_at_all_phases_would_show(light: dict[str, Any]) -> None:
    """The tone curve is that of the display, so that contrasts are proportional to the swing."""
    scene = _PHONE.replace(
        **light, exposure_time=1e-3, illuminance=9000.0, flicker_depth=0.004, luminance=1000.0,
        averaging="light", gamma=2.2, iso=5.0, full_well=1e9, readout_time=0.01, columns=2000,
    )  # fmt: skip
    name = "mains_depth" if light["light"] == "mains" else "depth"
    for contrast in (0.0099, 0.0101):  # bars are visible from 1 %
        factor = contrast / light_depth(scene).peak_to_peak
        changes = {name: factor * light[name], "flicker_depth": factor * 0.004}
        found = occ.band_depth(scene.replace(**changes))
        assert found.columns.peak_to_peak < 1e-9
        assert ("same phase" in found.hidden) == (contrast > 0.01)


def test_the_period_is_that_of_the_columns_where_they_do_not_see_the_strongest_sine() -> None:
    # The strongest of eight, the fourth, is seen at the same phase by all columns.
    scene = _PHONE.replace(pattern="10101000", switching_frequency=2.0 * 2**16,
                           readout_time=2.0**-16, exposure_time=2.0**-18)  # fmt: skip
    profile = occ.column_profile(scene)
    assert np.ptp(profile[::4]) < 1e-9 < np.ptp(profile[:4])
    assert 4.0 % occ.band_depth(scene).period == pytest.approx(0.0)


def test_columns_in_the_dark_have_no_bars_by_rounding() -> None:
    # The ramps' integrals leave some 1e-17 of the light in exposures that end before it.
    scene = _pulses(
        7, 1, 200.0 / 7, 5e-5, columns=100, readout_time=8e-6, edge_time=7.5e-3, start_time=0.0293
    )
    found = occ.band_depth(scene)
    assert occ.column_profile(scene.replace(edge_time=0.0)).max() == 0.0
    assert (found.columns, found.pixel, found.period) == (Depth(0, 0), Depth(0, 0), math.inf)
    assert "black" in found.sentence


_FEWEST_SAMPLES = 400  # within an exposure, and in each period and edge


def _sampled_columns(scene: Scene) -> tuple[FloatArray, FloatArray]:
    """Return each column's lit fraction and the ambient light's, sampled within its exposure."""
    sent, camera, around = scene.transmitter, scene.camera, scene.surroundings
    chips = occ.packet(scene).astype(float)
    before = np.concatenate([[0.0], np.cumsum(chips)])

    def sent_until(x: FloatArray) -> FloatArray:
        periods, rest = np.divmod(x, len(chips))
        return periods * before[-1] + np.interp(rest, np.arange(len(before)), before)

    start = scene.model.start_time + camera.readout_time * np.arange(camera.columns)
    count = _FEWEST_SAMPLES * math.ceil(camera.exposure_time * sent.switching_frequency)
    inside = (np.arange(count) + 0.5) / count * camera.exposure_time
    light = np.empty(len(start))
    for column, first in enumerate(start):
        x = (first + inside) * sent.switching_frequency
        edge = max(sent.edge_time * sent.switching_frequency, 1e-3)
        light[column] = ((sent_until(x) - sent_until(x - edge)) / edge).mean()
    angle = 2.0 * math.pi * around.flicker_frequency * (start[:, None] + inside[:: count // 200])
    ambient = 1.0 + around.flicker_depth * np.cos(angle + around.flicker_phase).mean(axis=1)
    return light, ambient


def _shown_contrasts(scene: Scene) -> tuple[float, float, float]:
    """Return the contrast on a display, that without a limit of pixels, and the largest value."""
    lit, ambient = _sampled_columns(scene)
    reflected = 0.4 / math.pi * scene.surroundings.illuminance * ambient
    camera, sent = scene.camera, scene.transmitter.luminance
    gain = camera.iso * camera.exposure_time / (12.5 * camera.f_number**2)
    values = 118.0 * (gain * (reflected + sent * lit)) ** (1.0 / camera.gamma)
    contrast, unlimited = (
        float(np.ptp(each) / max(each.mean(), 1e-300))
        for each in (np.minimum(values, 255.0) ** 2.2, values**2.2)
    )
    return contrast, unlimited, float(values.max())


def _any_scene(random: np.random.Generator) -> Scene:
    """A lamp, a flicker or both at any brightness; every second one nearly in step with columns."""
    chips = "".join(map(str, random.integers(0, 2, int(random.integers(1, 9)))))
    readout = float(10.0 ** random.uniform(-5.5, -4.0))
    frequency = float(10.0 ** random.uniform(2.5, 4.5))
    if random.random() < 0.5:
        off = float(random.choice([0.0, 1e-6, 1e-3])) * random.random()
        frequency = len(chips) / readout / int(random.integers(1, 5)) * (1.0 + off)
    exposure = float(10.0 ** random.uniform(-1.5, 0.8)) / frequency
    scene = _PHONE.replace(
        pattern=f"10{chips}", switching_frequency=frequency, readout_time=readout, columns=100,
        exposure_time=exposure, averaging="light", full_well=1e9,
        edge_time=float(random.choice([0.0, 0.3 / frequency])),
        luminance=float(random.choice([0.0, 300.0, 3000.0])),
        illuminance=float(random.choice([0.0, 300.0, 3000.0])),
        flicker_depth=float(random.choice([0.0, 0.02, 0.5])), flicker_frequency=120.0,
        start_time=float(random.uniform(0.0, 0.1)),
    )  # fmt: skip
    white = 5.5 * 12.5 * scene.camera.f_number**2 / exposure / 1000.0  # ISO speed of a white panel
    return scene.replace(iso=float(np.clip(white * 10.0 ** random.uniform(-3.0, 1.5), 1.0, 4e6)))


def test_bars_are_called_visible_where_sampled_columns_show_them() -> None:
    random = np.random.default_rng(26)
    tried = {"visible": 0, "overexposed": 0, "black": 0, "not visible": 0}
    for _ in range(amount(150, 2000)):
        scene = _any_scene(random)
        if scene.transmitter.luminance == scene.surroundings.illuminance == 0.0:
            continue
        found = occ.band_depth(scene)
        contrast, unlimited, brightest = _shown_contrasts(scene)
        sure = [not 0.8 < each / found.threshold < 1.25 for each in (contrast, unlimited)]
        if not all(sure) or 0.4 < brightest < 0.6:
            continue
        seen = contrast > found.threshold
        kind = (
            "black" if brightest < 0.5
            else "visible" if seen
            else "overexposed" if unlimited > found.threshold
            else "not visible"
        )  # fmt: skip
        tried[kind] += 1
        assert found.is_visible == (kind == "visible"), scene
        for word in ("overexposed", "black"):
            assert (word in found.sentence) == (word == kind), (scene, found.sentence)
    assert min(tried.values()) >= 1, tried


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


def _reference(scene: Scene) -> tuple[Fraction, Fraction]:
    """Return peak to peak and mean square over the mean, of both: a second difference."""
    exact = ExactTimes(scene)
    exposure, edge = exact.exposure, exact.edge
    period, lit = len(exact.chips), sum(exact.chips)
    mean = Fraction(lit, period) * exposure

    def light(start: Fraction) -> Fraction:
        ends = (start + exposure, start, start + exposure - edge, start - edge)
        far, near, far_before, near_before = map(exact.lit_until_integrated, ends)
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
        peak, square = _reference(scene)
        found = light_depth(scene)
        worst = max(worst, abs(found.peak_to_peak - peak), abs(found.rms - math.sqrt(square)))
    assert worst < 1e-13
