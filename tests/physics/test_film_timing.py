"""Laws of a film's frames: each is exact at its own time, after any running time."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hard_cases.references import ExactTimes
from hypothesis import given, strategies as st
from simulated_films import ShutterTiming

import occ_model as occ
from occ_model.effects.light_effects import ambient_fractions
from occ_model.scene.scene import Scene
from occ_model.video.period import SentPeriod

SMALL = Scene().replace(rows=24, columns=256, readout_time=1e-4, distance=0.8)


def exact_on_time(scene: Scene, start: Fraction, column: int) -> float:
    """Add up the lit chips in one column's exposure in exact arithmetic."""
    exact = ExactTimes(scene)
    begin = (start + column * Fraction(scene.camera.readout_time)) * exact.frequency
    return float(
        (exact.lit_until(begin + exact.exposure) - exact.lit_until(begin)) / exact.frequency
    )


@given(
    index=st.integers(0, 10_000_000),
    rate=st.floats(24.0, 30.0),
    frequency=st.floats(100.0, 1e5),
    camera=st.floats(-1e-4, 1e-4),
    led=st.floats(-1e-4, 1e-4),
    column=st.integers(0, 255),
)
def test_a_frame_is_as_exact_after_days_as_at_once(
    index: int, rate: float, frequency: float, camera: float, led: float, column: int
) -> None:
    recording = occ.Recording(frame_rate=rate, camera_drift=camera, transmitter_drift=led)
    film = occ.render_video(SMALL.replace(switching_frequency=frequency), recording=recording)
    scene = film.scene_of(index)
    start = Fraction(SMALL.model.start_time) + index / Fraction(rate) / (1 + Fraction(camera))
    assert film.start_of(index) == start
    exact = exact_on_time(scene, start, column)
    # Rounding of a time within one packet of 24 chips as a double, in chips.
    assert occ.on_time(scene)[column] * frequency == pytest.approx(exact * frequency, abs=2e-14)


@pytest.mark.parametrize("index", [1, 2, 77])
def test_a_frame_is_the_picture_of_the_scene_at_its_time(index: int) -> None:
    scene = SMALL.replace(start_time=0.25)
    # At 32 frames a second the times are exact doubles, so that none needs to be reduced.
    film = occ.render_video(scene, recording=occ.Recording(frame_rate=32.0))
    later = scene.replace(start_time=0.25 + index / 32.0)
    expected = occ.render(later, seed=film.seed_of(index))
    np.testing.assert_array_equal(film.frame(index).image, expected.camera_image)


def test_frames_begin_with_the_scene_itself() -> None:
    assert occ.render_video(SMALL.replace(start_time=1e-4)).scene_of(0) == SMALL.replace(
        start_time=1e-4
    )


@given(index=st.integers(0, 10_000_000), mains=st.floats(90.0, 130.0))
def test_the_mains_keep_their_phase_however_long_the_film(index: int, mains: float) -> None:
    scene = SMALL.replace(
        flicker_depth=0.5, flicker_frequency=mains, flicker_phase=1.0, illuminance=3000.0
    )
    film = occ.render_video(scene, recording=occ.Recording(frame_rate=29.97))
    seen = ambient_fractions(film.scene_of(index))[100]
    exposure = scene.camera.exposure_time
    middle = index / Fraction(29.97) + 100 * Fraction(1e-4) + Fraction(exposure) / 2
    with mpmath.workdps(50):
        turn = mpmath.mpf(middle.numerator) / middle.denominator * mpmath.mpf(mains)
        half = mpmath.pi * mains * mpmath.mpf(exposure)
        swing = mpmath.sin(half) / half * mpmath.cos(2 * mpmath.pi * turn + 1)
        expected = float(1 + mpmath.mpf(0.5) * swing)
    assert seen == pytest.approx(expected, abs=1e-14)


def test_a_clock_that_is_too_fast_has_shorter_times_and_higher_frequencies() -> None:
    scene = SMALL.replace(switching_frequency=8e3)
    camera = occ.render_video(scene, recording=occ.Recording(camera_drift=1e-4)).scene_of(30)
    assert camera.camera.readout_time * (1 + 1e-4) == pytest.approx(1e-4, rel=1e-15)
    assert camera.camera.exposure_time * (1 + 1e-4) == pytest.approx(136e-6, rel=1e-15)
    assert camera.transmitter.switching_frequency == 8e3
    led = occ.render_video(scene, recording=occ.Recording(transmitter_drift=1e-4)).scene_of(30)
    assert led.transmitter.switching_frequency == pytest.approx(8000.8, rel=1e-15)
    assert led.camera == scene.camera


def test_the_packets_of_a_published_example_are_received_as_counted() -> None:
    """CamComSim's example: 33.3 ms a frame, a gap of 0.2, 8,000 chips/s, packets of 52 chips.

    They are 4 start chips, 8 bits of header and 16 of payload in Manchester code
    (``vlc-citi-lab/camcomsim``, ``simu_params_template.json``), as many as those of 24 bits here.
    """
    period, gap, columns = Fraction(333, 10_000), Fraction(1, 5), 1080
    bits = np.random.default_rng(1).integers(0, 2, 24)
    scene = Scene().replace(
        line_code="manchester", framing="paper", payload="bits:" + "".join(map(str, bits)),
        switching_frequency=8e3, exposure_time=25e-6, iso=800.0,
        readout_time=float((1 - gap) * period / columns), rows=48, columns=columns,
        distance=0.4, panel_width=2.0, panel_height=2.0,
    )  # fmt: skip
    length = SentPeriod(scene.transmitter).part_length
    assert length == 52
    frames = 33
    video = occ.render_video(scene, frames, occ.Recording(frame_rate=float(1 / period)))
    reading = occ.decode_video(video, scene)
    assert reading.bits.tolist() == bits.tolist()
    counted = sum(
        ShutterTiming(scene, video.start_of(number)).whole_packets(length)
        for number in range(frames)
    )
    sent = len(reading.packets)
    assert reading.read / sent == pytest.approx(counted / sent, abs=0.02)
    # A view of V >= L chips contains on average (V - L) / L whole packets of L chips.
    average = float(((1 - gap) * period - Fraction(length, 8000)) / period)
    assert counted / sent == pytest.approx(average, abs=0.02)
