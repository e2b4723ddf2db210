"""The light along the columns agrees with the exposure; marks are where the picture changes."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.scene.scene import Scene
from occ_model.teaching.light_over_columns import chips_in_exposure, light_over_columns
from occ_model.teaching.marked_values import marked_values

LIGHTS: tuple[dict[str, Any], ...] = (
    {"light": "lamp", "lamp_frequency": 2390.0, "duty": 0.3, "depth": 0.8},
    {"light": "lamp", "lamp_frequency": 2390.0, "duty": 1.0},
    {"light": "mains", "mains_frequency": 50.0, "mains_depth": 0.3, "luminance": 100.0},
    {"light": "waveform", "levels": "0 1 2 3 2 / 3"},
    {"light": "waveform", "waveform_file": "0,1\n1e-4,0.2\n7e-4,0\n8e-4\n"},
    {"light": "pulses", "pulse_frequency": 1e3, "pulse_length": 3e-5, "start_time": -2e4},
)
CHANGES: tuple[dict[str, Any], ...] = (
    *LIGHTS,
    {},
    {"start_time": 1.2345e5},
    {"switching_frequency": 3.3e3, "start_time": -7e-4},
    {"switching_frequency": 47e3},
    {"pattern": "010100010110001001000"},
)


def scene_with(**changes: Any) -> Scene:
    return occ.load_preset("phone-136us").replace(columns=400, **changes)


@pytest.mark.parametrize("changes", CHANGES)
def test_the_mean_of_the_light_over_an_exposure_is_the_on_time(changes: dict[str, Any]) -> None:
    scene = scene_with(**changes)
    width = scene.camera.exposure_time / scene.camera.readout_time
    curve = light_over_columns(scene, -1.0, 400.0 + width, 10_000)
    fraction = occ.on_time(scene) / scene.camera.exposure_time
    found = [curve.mean(i + 0.0, i + width) for i in range(400)]
    # A cosine is drawn in steps: within one, it moves by half of its swing at most.
    error = 0.3 * np.pi / 256 if scene.transmitter.light == "mains" else 1e-7
    np.testing.assert_allclose(found, fraction, atol=error)


@pytest.mark.parametrize("edge", [5e-6, 60e-6, 250e-6])
def test_with_edges_the_light_is_the_mean_over_the_last_edge_time(edge: float) -> None:
    scene = scene_with(edge_time=edge)
    width = scene.camera.exposure_time / scene.camera.readout_time
    curve = light_over_columns(scene, -1.0, 400.0 + width, 10_000, edged=True)
    sharp = light_over_columns(scene, -100.0, 400.0 + width, 10_000)
    lag = edge / scene.camera.readout_time
    for x in np.linspace(0.0, 400.0, 37).tolist():
        value = float(np.interp(x, curve.columns, curve.light))
        assert value == pytest.approx(sharp.mean(x - lag, x), abs=1e-9)


def test_each_chip_is_the_one_sent_at_its_place() -> None:
    scene = scene_with()
    curve = light_over_columns(scene, 10.3, 380.2, 10_000)
    np.testing.assert_array_equal(curve.levels, occ.packet(scene)[curve.places])
    assert curve.edges[0] <= 10.3
    assert curve.edges[-1] > 380.2
    middles = (curve.edges[:-1] + curve.edges[1:]) / 2
    assert [curve.light_at(x) for x in middles.tolist()] == curve.levels.tolist()
    assert [curve.light_at(x) for x in curve.edges[:-1].tolist()] == curve.levels.tolist()


def test_too_many_chips_give_none() -> None:
    scene = scene_with(switching_frequency=1e9)
    assert light_over_columns(scene, 0.0, 399.0, 2000) is None


@pytest.mark.parametrize("chips", [0.3, 1.0, 1.36, 2.0, 4.5])
def test_an_exposure_includes_parts_of_as_many_chips(chips: float) -> None:
    scene = scene_with(exposure_time=chips * 2**-13, switching_frequency=2.0**13)
    fewest = chips_in_exposure(scene)
    seen = set()
    for start in np.linspace(0.0, 1.0, 50, endpoint=False).tolist():
        seen.add(int(np.ceil(start + chips) - np.floor(start)))
    assert seen <= {fewest, fewest + 1}
    assert fewest in seen


def test_the_band_model_ends_and_stripes_vanish_at_the_marks() -> None:
    scene = occ.load_preset("phone-136us").replace(pattern="10")
    for name in ("switching_frequency", "exposure_time"):
        equal, null = marked_values(scene, name)
        longer = scene.replace(**{name: equal.value * 1.001})
        occ.band_lengths(scene.replace(**{name: equal.value * 0.999}))
        with pytest.raises(occ.BandModelUndefined):
            occ.band_lengths(longer)
        assert np.ptp(occ.column_profile(scene.replace(**{name: null.value}))) < 0.1
    assert marked_values(scene, "distance") == ()


@pytest.mark.parametrize("parameter", ["exposure_time", "switching_frequency"])
@pytest.mark.parametrize("pattern", ["10", "1110", "1010", "110100", ""])
def test_bars_vanish_at_their_mark_and_not_before(pattern: str, parameter: str) -> None:
    scene = occ.load_preset("phone-136us").replace(pattern=pattern, switching_frequency=8192.0)
    mark = marked_values(scene, parameter)[-1]
    assert mark.label == "no bars"
    assert occ.band_depth(scene.replace(**{parameter: mark.value})).peak_to_peak < 1e-12
    for part in (0.3, 0.5, 0.9):
        assert occ.band_depth(scene.replace(**{parameter: part * mark.value})).peak_to_peak > 0.005


def test_no_mark_says_no_bars_if_nothing_blinks_or_the_surroundings_flicker() -> None:
    scene = occ.load_preset("phone-136us").replace(pattern="10")
    for changes in ({"pattern": "11"}, {"luminance": 0.0}):
        marks = marked_values(scene.replace(**changes), "exposure_time")
        assert [mark.label for mark in marks] == ["t = t_LED"]
    flickering = marked_values(scene.replace(flicker_depth=0.3), "exposure_time")
    assert [mark.label for mark in flickering] == ["t = t_LED", "whole pattern"]


def test_only_a_code_has_a_mark_at_two_chips() -> None:
    scene = occ.load_preset("phone-136us")
    for pattern, labels in (
        ("", ["t = t_LED", "null", "no bars"]),
        ("10", ["t = t_LED", "no bars"]),
    ):
        marks = marked_values(scene.replace(pattern=pattern), "exposure_time")
        assert [mark.label for mark in marks] == labels


def test_a_scene_whose_packet_cannot_be_made_has_the_marks_of_its_timing() -> None:
    scene = occ.load_preset("phone-136us").replace(line_code="nrz", framing="c-ook")
    with pytest.raises(occ.ParameterError, match="does not limit runs"):
        occ.packet(scene)
    assert [mark.label for mark in marked_values(scene, "exposure_time")] == ["t = t_LED", "null"]


@pytest.mark.parametrize("changes", LIGHTS[:1] + LIGHTS[2:])
def test_no_columns_differ_at_the_marked_exposures_of_whole_periods(
    changes: dict[str, Any],
) -> None:
    scene = scene_with(**changes).replace(readout_time=7.77e-6)
    marks = marked_values(scene, "exposure_time")
    *_, one, two = marks
    assert (one.label, two.label) == ("1 period", "2 periods")
    for mark, sees_bars in (
        (one, False),
        (two, False),
        (replace(one, value=0.9 * one.value), True),
    ):
        light = occ.on_time(scene.replace(exposure_time=mark.value)) / mark.value
        assert (np.ptp(light) > 1e-3) == sees_bars


@pytest.mark.parametrize("parameter", ["exposure_time", "lamp_frequency", "duty"])
def test_a_lamps_stripes_stop_to_be_fully_lit_and_dark_at_their_marks(parameter: str) -> None:
    scene = scene_with(light="lamp", lamp_frequency=1700.0, duty=0.3, readout_time=0.77e-6)
    marks = {mark.label: mark.value for mark in marked_values(scene, parameter)}
    for label, state, part in (("t = pulse", 1.0, "lit"), ("t = gap", 0.0, "dark")):
        for beyond in (-0.01, 0.01):
            # A larger duty has longer pulses, and shorter gaps.
            sign = -1.0 if (parameter, part) == ("duty", "lit") else 1.0
            changed = scene.replace(
                **{parameter: marks[label] * (1.0 + sign * beyond)}, columns=4000
            )
            light = occ.on_time(changed) / changed.camera.exposure_time
            has_state = bool(np.isclose(light, state, atol=1e-9).any())
            assert has_state == (beyond < 0.0), (label, beyond)


def test_the_nulls_of_frequencies_are_whole_multiples_of_one_over_the_exposure() -> None:
    scene = scene_with(exposure_time=2e-3, pulse_length=1e-4)
    for light, name, factor in (
        ("lamp", "lamp_frequency", 1.0), ("mains", "mains_frequency", 0.5),
        ("pulses", "pulse_frequency", 1.0), ("waveform", "switching_frequency", 4.0),
    ):  # fmt: skip
        marks = marked_values(scene.replace(light=light, exposure_time=0.02), name)
        nulls = [mark for mark in marks if "period" in mark.label]
        assert len(nulls) == 2
        for mark in nulls:
            k = int(mark.label.split()[0])
            assert mark.value == pytest.approx(factor * k / 0.02)


def test_a_steady_light_and_parameters_of_other_lights_have_no_marks() -> None:
    lamp = scene_with(light="lamp")
    for steady in (
        {"duty": 0.0}, {"duty": 1.0}, {"depth": 0.0}, {"light": "mains", "mains_depth": 0.0},
        {"light": "waveform", "levels": "1 1"}, {"luminance": 0.0},
        {"light": "pulses", "pulse_frequency": 1e4, "pulse_length": 1.0},
    ):  # fmt: skip
        assert marked_values(lamp.replace(**steady), "exposure_time") == ()
    assert marked_values(lamp, "switching_frequency") == ()
    assert marked_values(lamp, "pulse_length") == ()
