"""Films of an LED of 1 kHz, 91.08 µs a column, in three containers, beside guesses of it."""

from functools import cache
from pathlib import Path

import pytest

import occ_model as occ
from occ_model.results.clock import Clock

FOLDER = Path(__file__).parent / "films"
ENDINGS = ("mkv", "mp4", "avi")
READOUT, FREQUENCY = 91.08e-6, 2e3  # the frequency of its half cycles
LED = occ.load_preset("phone-136us").replace(
    pattern="10", switching_frequency=FREQUENCY, exposure_time=250e-6
)


@cache
def clock_of(ending: str, guess: float, frequency_tolerance: float | None = None) -> Clock:
    film = occ.load_video(FOLDER / f"led1k_30fps.{ending}")
    scene = LED.replace(readout_time=guess)
    reading = occ.decode_video(film, scene, frequency_tolerance=frequency_tolerance)
    assert reading.clock is not None
    return reading.clock


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("guess", [88e-6, 91e-6])
def test_the_true_clock_stands_first_and_beside_its_neighbours(ending: str, guess: float) -> None:
    clock = clock_of(ending, guess)
    assert abs(clock.readout_time.value - READOUT) < 4.0 * clock.readout_time.error
    assert abs(clock.switching_frequency.value - FREQUENCY) < 4.0 * clock.switching_frequency.error
    assert not clock.is_sure
    # Half cycles of lamps that show the same in every frame are 60 Hz apart.
    for other in clock.alternatives:
        apart = (other.switching_frequency.value - clock.switching_frequency.value) / 60.0
        assert apart == pytest.approx(round(apart), abs=2e-3)
        assert round(apart) != 0


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_known_frequency_leaves_one_readout_time_whatever_is_guessed(ending: str) -> None:
    clock = clock_of(ending, 88e-6, 1e-4)
    assert clock.is_sure
    assert abs(clock.readout_time.value - READOUT) < 4.0 * clock.readout_time.error
    assert clock.readout_time.error < 2e-4 * READOUT
    assert clock.slow_motion == 1
