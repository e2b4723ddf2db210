"""What shows no bars: ranges, shutter speeds and the map, against the depth itself and pictures."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from amount import amount
from exact_light import OTHER_LIGHTS
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.results.bands import NO_BARS_DEPTH
from occ_model.scene.scene import Scene
from occ_model.study.bands.advice import cure_of, shutter_speeds
from occ_model.study.bands.depth import light_depth
from occ_model.study.bands.least_depth import DepthOver

_PHONE = occ.load_preset("phone-136us")
_CODES = st.text("01", min_size=2, max_size=24).filter(lambda chips: len(set(chips)) == 2)


def _lamp(pattern: str, frequency: float, **others: float) -> Scene:
    return _PHONE.replace(pattern=pattern, switching_frequency=frequency, **others)


def _depth(scene: Scene, **changes: float) -> float:
    return light_depth(scene.replace(**changes)).peak_to_peak


@st.composite
def _lights(draw: st.DrawFn) -> dict[str, Any]:
    """Draw a light of each kind that repeats 20 to 2000 times a second."""
    base, fraction = draw(st.floats(20.0, 2000.0)), st.floats(0.01, 0.99)
    levels = draw(st.lists(st.sampled_from([0.0, 0.2, 1.0]), min_size=2, max_size=24))
    ends = np.cumsum(draw(st.lists(fraction, min_size=len(levels), max_size=len(levels))))
    rows = zip(np.append(0.0, ends / ends[-1] / base).tolist(), [*levels, ""], strict=True)
    return draw(st.sampled_from([
        {"light": "lamp", "lamp_frequency": base, "duty": draw(fraction), "depth": draw(fraction)},
        {"light": "lamp", "lamp_frequency": base, "duty": draw(st.sampled_from([0.3, 0.5]))},
        {"light": "mains", "mains_frequency": base / 2, "mains_depth": draw(fraction)},
        {"light": "pulses", "pulse_frequency": base, "pulse_length": draw(fraction) / base},
        {"light": "waveform", "levels": " ".join(map(str, levels)),
         "switching_frequency": base * len(levels)},
        {"light": "waveform", "waveform_file": "\n".join(f"{at},{level}" for at, level in rows)},
    ]))  # fmt: skip


_PATTERNS = _CODES.map(lambda pattern: {"pattern": pattern, "switching_frequency": 5e3})


@given(
    light=st.one_of(_PATTERNS, _lights()), exposure=st.floats(1e-6, 0.1),
    flicker=st.sampled_from([0.0, 0.4]),
)  # fmt: skip
@settings(deadline=None, max_examples=amount(60, 1000))
def test_the_depth_over_ranges_is_that_of_each_scene_or_lies_closely_above(
    light: dict[str, Any], exposure: float, flicker: float
) -> None:
    scene = _PHONE.replace(**light, exposure_time=exposure, flicker_depth=flicker)
    over = DepthOver.of(scene)
    found, exact = float(over.depths(np.array([exposure]))[0]), light_depth(scene).peak_to_peak
    assert found >= exact * (1.0 - 1e-6) - 1e-9
    if light.get("light") != "waveform":
        assert found == pytest.approx(exact, rel=1e-6, abs=1e-9)
    at_nodes = over.nodes_to(3.0, 0.5) / over.axis.frequency
    for at in at_nodes[:: 1 + len(at_nodes) // 4]:
        if len(over.nodes) <= 25:  # the grid of many unequal pieces is not exact everywhere
            assert float(over.depths(np.array([at]))[0]) == pytest.approx(
                _depth(scene, exposure_time=float(at)), rel=1e-6, abs=1e-9
            )


@given(light=st.one_of(_PATTERNS, _lights()), flicker=st.sampled_from([0.0, 0.4]))
@settings(deadline=None, max_examples=20)
def test_the_least_depth_of_a_range_is_not_above_any_within_and_is_reached(
    light: dict[str, Any], flicker: float
) -> None:
    over = DepthOver.of(_PHONE.replace(**light, flicker_depth=flicker))
    ends = np.geomspace(1e-5, 3e-2, 30)
    least = over.least_depths(over.axis.frequency, ends)
    for index, (low, high) in enumerate(pairwise(ends)):
        depths = over.depths(np.linspace(low, high, 4001))
        assert least[index] <= depths.min() + 1e-12
        assert least[index] == pytest.approx(depths.min(), abs=2.0 * np.abs(np.diff(depths)).max())


@pytest.mark.parametrize(
    ("light", "parameter", "factor", "flicker"),
    [({"pattern": "10", "switching_frequency": 3840.0}, "switching_frequency", 2.0, 0.0),
     ({"pattern": "1000", "switching_frequency": 4000.0}, "switching_frequency", 4.0, 0.3),
     ({"pattern": "1101001", "switching_frequency": 9e3}, "switching_frequency", 1.0, 0.1),
     ({"light": "lamp", "lamp_frequency": 239.0, "duty": 0.3}, "lamp_frequency", 1.0, 0.0),
     ({"light": "mains", "mains_depth": 0.5}, "mains_frequency", 0.5, 0.0)],
)  # fmt: skip
def test_exposures_and_frequencies_without_bars_end_where_the_depth_reaches_the_limit(
    light: dict[str, Any], parameter: str, factor: float, flicker: float
) -> None:
    scene = _PHONE.replace(**light, flicker_depth=flicker, exposure_time=1 / 50)
    advice = occ.band_advice(scene)
    for name, scale, ranges, rest in (
        ("exposure_time", 1.0, advice.exposures, advice.all_exposures),
        (parameter, factor, advice.frequencies, advice.all_frequencies),
    ):

        def depth(at: float, name: str = name, scale: float = scale) -> float:
            return _depth(scene, **{name: scale * at})

        before, least = 0.0, 1e-9 if name[0] == "e" else 1.0
        for low, high in ranges:
            inside = np.linspace(low, high, amount(2, 9))
            assert max(map(depth, inside)) <= NO_BARS_DEPTH * (1 + 1e-9)
            assert depth(low * (1 - 1e-6)) >= NO_BARS_DEPTH
            assert depth(high * (1 + 1e-6)) >= NO_BARS_DEPTH
            # Nothing between two ranges was left out.
            gap = [at for at in np.linspace(before, low, amount(3, 12))[1:-1] if at > least]
            assert before == 0.0 or min(map(depth, gap)) >= NO_BARS_DEPTH
            before = high
        # The largest frequencies of the mains do not reach beyond 1 kHz.
        if rest is None or (name, parameter) == (parameter, "mains_frequency"):
            continue
        for factor_above in np.geomspace(1.0 + 1e-9, 8.0, amount(4, 50)):
            assert depth(rest * factor_above) <= NO_BARS_DEPTH * (1 + 1e-6)
        assert depth(rest * (1 - 1e-6)) >= NO_BARS_DEPTH


@given(light=_lights())
@settings(deadline=None, max_examples=amount(15, 200))
def test_no_exposure_that_is_said_to_be_without_bars_has_any(light: dict[str, Any]) -> None:
    scene = _PHONE.replace(**light)
    advice = occ.band_advice(scene)
    for low, high in advice.exposures[:4]:
        for at in np.linspace(low, high, 5):
            assert _depth(scene, exposure_time=at) <= NO_BARS_DEPTH * (1 + 1e-9)
    if advice.valley:
        assert _depth(scene, exposure_time=3.0 * advice.valley) < 1e-9


def test_a_lamp_of_120_hz_shows_no_bars_at_a_60th_where_the_camera_keeps_it() -> None:
    # A published list for 300 Hz: no bars at 1/25, 1/30, 1/50, 1/60 and 1/100 s.
    scene = _lamp("10", 600.0, illuminance=0.0)
    free = {each.name for each in occ.band_advice(scene).speeds if each.at_nominal < NO_BARS_DEPTH}
    assert {"1/25 s", "1/30 s", "1/50 s", "1/60 s", "1/100 s"} <= free
    assert "1/80 s" not in free
    kept = {each.name: each for each in occ.band_advice(scene).speeds}
    # A camera that keeps 1/64 s for 1/60 s holds 4.6875 periods: 0.3125 of one is left over.
    assert kept["1/60 s"].at_real == pytest.approx(2.0 * 0.3125 / 4.6875, rel=1e-9)
    assert kept["1/60 s"].is_doubtful
    assert not kept["1/60 s"].is_free


def test_speeds_in_thirds_are_as_written_within_rounding() -> None:
    for speed in shutter_speeds():
        assert speed.real == pytest.approx(speed.nominal, rel=0.07)
    real = {speed.name: 1.0 / speed.real for speed in shutter_speeds()}
    assert real["1/60 s"] == 64.0
    assert real["1/125 s"] == 128.0
    assert real["1/50 s"] == pytest.approx(50.8, abs=0.05)
    assert real["1/120 s"] == pytest.approx(120.0)


def test_a_picture_at_an_advised_speed_has_no_bars_and_at_another_it_has() -> None:
    lamp = _lamp("1110", 4 * 480.0, illuminance=290.0, columns=3000, rows=600, distance=0.3)
    depths = {}
    for speed in ("1/60 s", "1/125 s"):
        time = next(each.nominal for each in shutter_speeds() if each.name == speed)
        # Two stops of a filter each, so that no pixel is full.
        scene = lamp.replace(exposure_time=time, iso=100.0, luminance=136e-6 / time * 3600.0,
                             illuminance=136e-6 / time * 290.0)  # fmt: skip
        image = occ.render(scene, tolerance=0.0, seed=1).camera_image[200:400, 800:2200]
        profile = image.mean(axis=0)
        depths[speed] = profile.std() / profile.mean()
    assert depths["1/60 s"] < 0.003
    assert depths["1/125 s"] > 0.01


def test_a_flicker_that_no_frequency_of_the_lamp_can_cure_is_told_by_none() -> None:
    scene = _lamp("10", 1e3, flicker_depth=1.0, exposure_time=1e-3, illuminance=1e4)
    advice = occ.band_advice(scene)
    assert advice.frequencies == ()
    assert advice.all_frequencies is None
    assert advice.all_exposures is not None


_FLICKER = {"flicker_depth": 0.9, "flicker_frequency": 120.0, "illuminance": 1000.0}


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({}, "The lamp's bars vanish at whole multiples of 200 µs."),
        ({"luminance": 0.0, **_FLICKER},
         "The bars of the surroundings' flicker vanish at whole multiples of 8.333 ms."),
        (_FLICKER, "The lamp's bars vanish at whole multiples of 200 µs; the bars of the "
         "surroundings' flicker vanish at whole multiples of 8.333 ms."),
        ({**_FLICKER, "illuminance": 0.0}, "The lamp's bars vanish at whole multiples of 200 µs."),
        ({"luminance": 0.0}, "Nothing blinks: no exposure shows bars."),
    ],
)  # fmt: skip
def test_what_blinks_is_told_when_its_bars_vanish(changes: dict[str, float], sentence: str) -> None:
    scene = _lamp("10", 1e4, **changes)
    advice = occ.band_advice(scene)
    assert advice.sentence == sentence
    for valley, other in (
        (advice.valley, {"illuminance": 0.0}), (advice.flicker_valley, {"luminance": 0.0})
    ):  # fmt: skip
        alone = scene.replace(**other)
        for multiple in (1, 2, 3) if valley else ():
            assert _depth(alone, exposure_time=multiple * valley) < 1e-12
            assert _depth(alone, exposure_time=(multiple - 0.5) * valley) > 0.01


@pytest.mark.parametrize("flicker", [1e6, 1e9])
def test_a_flicker_of_any_frequency_takes_no_exposure_from_a_slow_lamp(flicker: float) -> None:
    lamp = _lamp("10", 1e3)
    fast = occ.band_advice(lamp.replace(flicker_depth=1.0, flicker_frequency=flicker))
    alone = occ.band_advice(lamp)
    assert fast.exposures == pytest.approx(np.array(alone.exposures), rel=1e-3)
    assert fast.all_exposures == pytest.approx(alone.all_exposures, rel=1e-3)


def test_a_long_exposure_s_bars_are_not_above_their_bounds() -> None:
    over = DepthOver.of(_lamp("1101000", 1e3, flicker_depth=1.0, flicker_frequency=777.0))
    exposures = np.geomspace(1e-3, 1e3, 20_001)
    for found, bound in (
        (over.depth_of_lamp(1e3 * exposures), over.bound_of_lamp(1e3 * exposures)),
        (over.depth_of_flicker(exposures), over.bound_of_flicker(exposures)),
    ):
        assert (found <= bound * (1.0 + 1e-9)).all()
        np.testing.assert_array_equal(found[exposures < 10.0], bound[exposures < 10.0])


@pytest.mark.parametrize("light", OTHER_LIGHTS)
def test_the_present_depth_of_any_light_is_that_of_its_bars(light: str) -> None:
    scene = occ.load_preset("phone-136us").replace(
        **OTHER_LIGHTS[light], illuminance=0.0, exposure_time=1.3e-3
    )
    depth = occ.band_depth(scene).peak_to_peak
    assert cure_of(scene).depth == pytest.approx((depth, depth), rel=1e-9)


@pytest.mark.parametrize(
    "steady",
    [
        {"light": "lamp", "duty": 0.0}, {"light": "lamp", "duty": 1.0},
        {"light": "lamp", "depth": 0.0}, {"light": "mains", "mains_depth": 0.0},
        {"light": "waveform", "levels": "0"}, {"light": "pulses", "pulse_length": 1.0},
    ],
)  # fmt: skip
def test_steady_light_needs_no_other_exposure(steady: dict[str, Any]) -> None:
    found = cure_of(occ.load_preset("phone-136us").replace(**steady))
    assert (found.repetition_rate, found.depth) == (0.0, (0.0, 0.0))
