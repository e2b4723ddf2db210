"""Equations and exposure windows agree with the model."""

import re

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.camera.photometry import WHITE, level_values
from occ_model.results.teaching import Equation
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND
from occ_model.teaching.equations import equations
from occ_model.teaching.lessons import EQUATIONS
from occ_model.teaching.light_over_columns import exposure_window, rolling_shutter

scenes = st.builds(
    lambda exposure, frequency, readout, iso, start, pattern, averaging: Scene().replace(
        exposure_time=exposure, switching_frequency=frequency, readout_time=readout, iso=iso,
        start_time=start, pattern=pattern, averaging=averaging, columns=500,
    ),
    exposure=st.floats(1e-5, 2e-3),
    frequency=st.floats(500.0, 1e5),
    readout=st.floats(1e-6, 1e-4),
    iso=st.floats(50.0, 6400.0),
    start=st.floats(-1e3, 1e3),
    pattern=st.sampled_from(["", "10", "1101000", "0", "1"]),
    averaging=st.sampled_from(["pixel-value", "light"]),
)  # fmt: skip

lights = st.sampled_from(["code", "lamp", "waveform", "pulses"])


_ROUNDED = 5.1e-3
"""Largest relative error of a result with three digits."""


def numbers_in(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?", text)]


def by_meaning(scene: Scene) -> dict[str, Equation]:
    keys = (
        "lit panel",
        "dark panel",
        "a column",
        "one state",
        "a transition",
        "of a chip",
        "whole picture",
        "no str",
    )
    found = equations(scene)
    return {k: e for k in keys for e in found if k in e.meaning}


@settings(max_examples=60)
@given(scenes)
def test_the_results_of_the_equations_are_those_of_the_model(scene: Scene) -> None:
    found = by_meaning(scene)
    assert len(found) == len(equations(scene)) == 8
    low, high = level_values(scene).tolist()
    assert numbers_in(found["lit panel"].result)[0] == pytest.approx(high, abs=0.051)
    assert numbers_in(found["dark panel"].result)[0] == pytest.approx(low, abs=0.051)
    assert ("saturated" in found["lit panel"].result) == (high > WHITE)
    averages_light = scene.model.averaging == "light"
    assert ("light is averaged, not pixel" in found["a column"].result) == averages_light
    span = numbers_in(found["a column"].result)[:2]
    assert span == pytest.approx([min(low, WHITE), min(high, WHITE)], abs=0.051)
    profile = occ.column_profile(scene)
    assert span[0] - 0.06 <= profile.min() <= profile.max() <= span[1] + 0.06
    chip = scene.transmitter.switching_period / scene.camera.readout_time
    assert numbers_in(found["of a chip"].result)[0] == pytest.approx(chip, rel=_ROUNDED)
    whole = scene.camera.columns * scene.camera.readout_time
    stated = SECOND.parse(found["whole picture"].result, 1.0)
    assert stated == pytest.approx(whole, rel=_ROUNDED)
    try:
        lengths = occ.band_lengths(scene)
    except occ.BandModelUndefined:
        assert found["one state"].result.startswith("undefined")
        length = scene.camera.exposure_time / scene.camera.readout_time
        assert numbers_in(found["a transition"].result)[0] == pytest.approx(length, rel=_ROUNDED)
    else:
        shown = [numbers_in(found[k].result)[0] for k in ("one state", "a transition")]
        assert shown == pytest.approx(lengths, rel=_ROUNDED)


def test_at_the_equations_null_alternating_stripes_vanish() -> None:
    scene = Scene().replace(pattern="10", exposure_time=136e-6)
    messages = by_meaning(scene)["no str"].result
    null = PARAMETERS["switching_frequency"].parse(messages.split(";")[0])
    assert isinstance(null, float)
    at_null = occ.column_profile(scene.replace(switching_frequency=null))
    assert np.ptp(at_null) < 1e-3 * np.ptp(occ.column_profile(scene))


@pytest.mark.parametrize(
    ("light", "columns", "state"),
    [
        ({"light": "lamp", "lamp_frequency": 500.0, "duty": 0.3}, 250.0, 58.0),
        ({"light": "pulses", "pulse_frequency": 500.0, "pulse_length": 2e-4}, 250.0, 8.0),
        ({"light": "waveform", "levels": "0 1 2 / 2", "switching_frequency": 5e3}, 75.0, 8.0),
        ({"light": "waveform", "waveform_file": "0,1\n1e-3,0\n2e-3"}, 250.0, None),
        ({"light": "mains", "mains_frequency": 50.0}, 1250.0, None),
    ],
)
def test_equations_of_other_lights_are_in_their_periods_and_pulses(
    light: dict[str, ParameterValue], columns: float, state: float | None
) -> None:
    scene = Scene().replace(**light, exposure_time=136e-6, readout_time=8e-6)
    found = {equation.name: equation for equation in equations(scene)}
    assert numbers_in(found["chip-columns"].result) == [columns]
    assert ("one-state" in found) == (state is not None) == ("transition" in found)
    if state is not None:
        assert numbers_in(found["one-state"].result) == [state]
        too_long = scene.replace(exposure_time=136e-6 + 1.001 * state * 8e-6)
        texts = [equation.result for equation in equations(too_long)]
        assert any(text.startswith("undefined") for text in texts)
    ratio = float(found["null"].result.rpartition("= ")[2])
    assert ratio == pytest.approx(136.0 / 8.0 / columns, rel=_ROUNDED)
    words = " ".join(equation.meaning + equation.result for equation in found.values())
    assert "chip" not in words
    for equation in found.values():
        assert {n for t in equation.symbols for n in t.parameters} == equation.parameters
        assert all(PARAMETERS[name].is_of(scene.transmitter.light) for name in equation.parameters)


def test_the_columns_of_a_mains_lamp_reach_the_levels_of_its_equation() -> None:
    scene = Scene().replace(light="mains", exposure_time=5e-3, luminance=100.0, columns=2000)
    equation = next(each for each in equations(scene) if each.name == "column")
    profile = occ.column_profile(scene.replace(readout_time=1e-5))
    assert numbers_in(equation.result)[:2] == pytest.approx(
        [profile.min(), profile.max()], abs=0.06
    )


def test_lessons_know_the_equations_by_their_names() -> None:
    assert tuple(equation.name for equation in equations(Scene())) == tuple(EQUATIONS)


def test_every_parameter_of_a_term_changes_its_equation() -> None:
    scene = occ.load_preset("phone-68us")
    for equation in equations(scene):
        for term in (*equation.symbols, *equation.numbers):
            assert set(term.parameters) <= set(PARAMETERS)
        symbols = {name for term in equation.symbols for name in term.parameters}
        assert symbols == equation.parameters, equation.meaning
    for name, value in (("iso", 200.0), ("readout_time", 9e-6), ("switching_frequency", 9e3)):
        changed = equations(scene.replace(**{name: value}))
        for before, after in zip(equations(scene), changed, strict=True):
            shown = [(e.numbers, e.result.split(";")[0]) for e in (before, after)]  # no remark
            if shown[0] != shown[1]:
                assert name in after.parameters, after.meaning


def test_the_on_time_depends_on_exactly_the_parameters_that_its_term_names() -> None:
    scene = occ.Scene().replace(framing="preamble", columns=500)
    other: dict[str, ParameterValue] = {
        "code": 700, "bits": 12, "payload": "a", "pattern": "10", "line_code": "4b6b",
        "framing": "raw", "preamble": "1111000", "error_correction": "reed-solomon",
    }  # fmt: skip
    term = next(t for t in by_meaning(scene)["a column"].numbers if "<sub>on" in t.text)
    for name, declared in PARAMETERS.items():
        value = scene.value(name)
        if isinstance(value, float):
            assert isinstance(declared, Quantity)
            value = min(1.1 * value + 1e-3, declared.high)
        changed = scene.replace(**{name: other.get(name, value)})
        if changed == scene:
            continue
        time = occ.on_time(changed)
        moved = not np.array_equal(time, occ.on_time(scene))
        assert (name in term.parameters) == moved, name


@settings(max_examples=120)
@given(scenes, lights, st.integers(0, 499))
def test_the_lit_parts_of_a_window_add_up_to_the_models_time_on(
    scene: Scene, light: str, column: int
) -> None:
    scene = scene.replace(light=light, duty=0.3, depth=0.6)
    window = exposure_window(scene, column)
    assert window.on_time == occ.on_time(scene)[column]
    assert window.exposure_time == pytest.approx(scene.camera.exposure_time, rel=1e-9)
    assert not window.shortened
    begins, ends, light = window.lit_parts.T
    assert (ends > begins).all()
    assert ((ends - begins) * light).sum() == pytest.approx(
        window.on_time, abs=1e-9 * window.edges[-1]
    )
    assert window.edges[0] == 0.0 <= window.start <= window.end <= window.edges[-1]
    assert len(window.edges) == len(window.levels) + 1


def test_a_window_of_very_many_chips_is_cut_short_and_says_so() -> None:
    window = exposure_window(Scene().replace(exposure_time=1.0, switching_frequency=1e6), 3)
    assert window.shortened
    assert len(window.levels) <= 1000
    assert window.on_time == pytest.approx(0.5, abs=0.05)


@settings(max_examples=60, deadline=None)
@given(
    st.floats(500.0, 3e4), st.floats(1e-5, 1e-3), st.floats(1e-6, 5e-5), st.floats(-2.0, 2.0),
    st.sampled_from(["", "10", "1101000"]), lights,
)  # fmt: skip
def test_the_light_during_each_exposure_is_its_lit_fraction(
    frequency: float, exposure: float, readout: float, start: float, pattern: str, light: str
) -> None:
    scene = Scene().replace(
        switching_frequency=frequency, exposure_time=exposure, readout_time=readout,
        start_time=start, pattern=pattern, columns=400, light=light, pulse_frequency=700.0,
    )  # fmt: skip
    shown = rolling_shutter(scene)
    assert len(shown.columns) <= 25
    assert shown.edges[0] <= 0.0
    assert shown.edges[-1] >= shown.duration
    cumulated = np.concatenate([[0.0], np.cumsum(np.diff(shown.edges) * shown.levels)])
    ends = shown.starts + shown.exposure_time
    gathered = np.interp(ends, shown.edges, cumulated) - np.interp(
        shown.starts, shown.edges, cumulated
    )
    np.testing.assert_allclose(gathered / exposure, shown.lit_fraction, atol=1e-6)


@pytest.mark.parametrize("shown", [2, 7, 25])
def test_of_many_columns_as_many_are_shown_as_requested(shown: int) -> None:
    scene = occ.load_preset("phone-68us").replace(switching_frequency=1e3)
    columns = rolling_shutter(scene, shown).columns
    assert len(columns) == shown
    assert columns[0] == 0
