"""Answers about bars in one line, beats with frame rates, and dark rows of panels."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import occ_model as occ
from occ_model.results.bands import NO_BARS_DEPTH
from occ_model.scene.scene import Scene
from occ_model.study.bands.answer import FRAME_RATES, bars_answer, unlit_rows
from occ_model.study.bands.depth import light_depth


def _lamp(frequency: float, duty: float, exposure: float, **others: float | str) -> Scene:
    return Scene().replace(
        light="lamp", lamp_frequency=frequency, duty=duty, exposure_time=exposure, illuminance=0.0,
        **others,
    )  # fmt: skip


_MAINS = Scene().replace(light="mains", mains_frequency=60.0, illuminance=0.0)


def test_a_lamp_dimmed_at_240_hz_is_answered_in_one_line() -> None:
    answer = bars_answer(_lamp(240.0, 0.3, 1 / 100, readout_time=12e-6))
    # Of 2.4 periods 0.6 to 0.9 are lit, 0.72 on average: two times 0.3, and up to 0.3 more.
    assert answer.depth == pytest.approx(0.3 / 0.72)
    assert answer.sentence == (
        "Use 1/48 or 1/120 s: no bars. At 1/100 s they are 41.7 % of the mean light from "
        "dark to bright, 347 lines from bar to bar."
    )
    assert "vanish at whole multiples of 4.167 ms" in answer.details[0]
    unknown = bars_answer(_lamp(240.0, 0.3, 1 / 100), knows_readout=False)
    assert "lines" not in unknown.sentence


@given(
    frequency=st.floats(40.0, 30e3), duty=st.floats(0.01, 0.99), exposure=st.floats(1e-4, 0.5)
)  # fmt: skip
@settings(deadline=None, max_examples=30)
def test_an_advised_speed_shows_no_bars_and_others_are_said_to_show_some(
    frequency: float, duty: float, exposure: float
) -> None:
    scene = _lamp(frequency, duty, exposure)
    answer = bars_answer(scene)
    for speed in answer.speeds:
        assert light_depth(scene.replace(exposure_time=speed.nominal)).peak_to_peak < NO_BARS_DEPTH
        is_sure = light_depth(scene.replace(exposure_time=speed.real)).peak_to_peak < NO_BARS_DEPTH
        assert is_sure == speed.is_free
        assert is_sure or any("Many cameras keep" in line for line in answer.details)
    for multiple in (1, 2, 3):
        assert light_depth(scene.replace(exposure_time=multiple * answer.valley)).rms < 1e-12
    is_free = light_depth(scene).peak_to_peak < NO_BARS_DEPTH
    assert answer.sentence.startswith("No bars at") == is_free
    assert "chip" not in " ".join((answer.sentence, *answer.details))


def test_where_every_usual_speed_shows_bars_the_lamps_period_is_advised() -> None:
    answer = bars_answer(_lamp(239.0, 0.3, 1 / 100))
    assert answer.speeds == ()
    assert answer.sentence.startswith("Use 1/239 s, or a whole multiple of it: no bars.")
    assert "leaves the weakest bars: 1.39 %" in answer.details[1]


def test_a_steady_light_has_nothing_to_answer() -> None:
    answer = bars_answer(_lamp(240.0, 1.0, 1 / 100))
    assert answer.sentence == "This light is steady: no shutter time shows bars."
    assert answer.details == ()


def test_bars_of_the_mains_stand_still_or_wander_as_film_makers_know_them() -> None:
    of = {each.name: each for each in bars_answer(_MAINS.replace(exposure_time=1 / 100)).rates}
    assert {name for name, each in of.items() if each.stands_still} == {"24", "30", "60"}
    # 120 Hz and five times 23.976, or four times 29.97: 0.12 Hz, once in 8.34 s.
    for name in ("23.976", "29.97", "59.94"):
        assert of[name].frequency == pytest.approx(120 / 1001)
    assert of["25"].frequency == pytest.approx(5.0)
    assert of["50"].frequency == pytest.approx(20.0)
    assert "120" not in of  # no exposure of 1/100 s is possible there
    assert bars_answer(_MAINS.replace(exposure_time=1 / 120)).rates == ()  # no bars at all


def test_the_beats_of_each_sine_are_those_of_frames_in_a_film() -> None:
    scene = _lamp(1903.0, 0.27, 1 / 800, columns=100)
    for beats in bars_answer(scene).rates:
        rate = float(FRAME_RATES[beats.name])
        frames = np.arange(4000) / rate
        light = [
            occ.column_profile(
                scene.replace(start_time=start, averaging="light", gamma=1.0, columns=1)
            )[0]
            for start in frames[:400]
        ]
        strength = np.abs(np.fft.rfft(np.hanning(400) * (light - np.mean(light)), 16_000))
        loudest = float(np.fft.rfftfreq(16_000, 1.0 / rate)[strength.argmax()])
        near = min(abs(beat.frequency - loudest) for beat in beats.beats)
        assert near < rate / 400, beats.name


@given(
    rows=st.integers(1, 40), exposure=st.one_of(st.floats(1e-5, 0.05), st.just(0.05)),
    frequency=st.sampled_from([60.0, 83.0]),
)  # fmt: skip
@settings(deadline=None, max_examples=50)
def test_rows_of_a_panel_are_dark_or_cut_as_often_as_counted(
    rows: int, exposure: float, frequency: float
) -> None:
    found = unlit_rows(rows, frequency, exposure)
    window = exposure * frequency * rows  # in rows
    starts = (np.arange(997) + 0.5) / 997 * rows
    row = np.arange(rows)
    lit = np.zeros((len(starts), rows))
    for turn in range(math.ceil(exposure * frequency) + 1):
        first = row + turn * rows - starts[:, None]
        overlap = np.minimum(first + 1.0, window) - np.maximum(first, 0.0)
        lit += np.clip(overlap, 0.0, 1.0)
    assert found.dark == pytest.approx((lit < 1e-12).mean(), abs=2.5 / 997)
    is_cut = np.abs(lit - np.round(lit)) > 1e-9
    assert found.cut == pytest.approx(is_cut.mean(), abs=2.5 / 997 + 1e-9)


def test_a_panel_of_16_rows_shows_most_of_them_dark_at_a_short_exposure() -> None:
    scene = _lamp(60.0, 1 / 16, 1 / 1000)
    answer = bars_answer(scene, rows=16)
    assert answer.rows is not None
    # One row is lit at a time, and in 1 ms the light moves on by 60 x 16 / 1000 = 0.96 rows.
    assert answer.rows.dark == pytest.approx((15 - 0.96) / 16)
    assert "87.7 % of them are dark" in answer.details[-1]
    assert unlit_rows(16, 60.0, 1 / 30).dark == 0.0
