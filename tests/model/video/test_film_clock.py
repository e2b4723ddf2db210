"""The clock of a film from rounded times, and all solutions that what is known leaves."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from amount import amount
from each_case import each_case
from film_clocks import COLUMNS, KNOWN, RESOLUTIONS, FilmTruth, JudgedClock, judge_clocks

from occ_model.video.film_clock import describe_clock
from occ_model.video.frame_period import fit_rounded_period
from occ_model.video.frame_times import fit_frame_times
from occ_model.video.known_timing import CRYSTAL_TOLERANCE, KnownTiming

READOUT = 25e-6
LAMP = 2e3  # half cycles a second: a lamp of 1 kHz
MILLISECOND, HUNDREDTH = 1e-3, 1e-2
FILM = FilmTruth(LAMP, READOUT, 1 / 30, frames=60, period=2.0)


def lamp_known(frequency: float = LAMP, tolerance: float = CRYSTAL_TOLERANCE) -> KnownTiming:
    return KnownTiming(frequency, 1.3 * READOUT, tolerance, None)


def test_the_period_of_rounded_times_holds_for_nominal_and_other_rates() -> None:
    """A nominal rate lies at the tip of what its rounded times allow."""
    random = np.random.default_rng(7)
    off = []
    rates = (23.976, 24.0, 25.0, 29.97, 30.0, 50.0, 59.94, 90.0)
    resolutions = (1e-7, 1 / 90_000, MILLISECOND, HUNDREDTH)
    for rate, resolution in product(rates, resolutions):
        if resolution > 0.7 / rate:
            continue
        for _ in range(amount(8, 40)):
            count = int(random.integers(5, 150))
            period = (1.0 + random.uniform(-1e-4, 1e-4)) / rate
            times = random.uniform(0.0, 1.0) + np.arange(count) * period
            times += random.choice([0.0, 2e-5, 2e-4]) * random.standard_normal(count)
            rounded = np.round(times / resolution) * resolution
            found = fit_rounded_period(np.arange(float(count)), rounded, resolution)
            off.append(abs(found.value - period) / found.error)
    assert max(off) < 5.0
    # The standard deviation of this fraction in 240 trials is 1.4 %.
    assert np.mean(np.array(off) < 2.0) > 0.9


def test_the_error_of_a_rounded_period_is_not_larger_than_the_rounding_allows() -> None:
    times = np.round(np.arange(100) / 29.97 / MILLISECOND) * MILLISECOND
    found = fit_rounded_period(np.arange(100.0), times, MILLISECOND)
    assert 0.0 < found.error < MILLISECOND / 99 / 2


@each_case((24.0, 240.0, 480.0, 720.0))
def test_frames_are_counted_whatever_their_times_are_rounded_to(rate: float) -> None:
    times = np.floor(np.arange(200) / rate / MILLISECOND) * MILLISECOND
    found = fit_frame_times(times, MILLISECOND)
    assert found.numbers.tolist() == list(range(200))
    assert found.problems == ()
    assert abs(found.period.value - 1.0 / rate) < 4.0 * found.period.error


def test_a_container_that_counts_frames_states_an_exact_period() -> None:
    found = fit_frame_times(np.arange(50) / 25.0, 0.04)
    assert (found.resolution, found.period.error) == (0.0, pytest.approx(0.0, abs=1e-12))


@each_case((0.0, MILLISECOND, HUNDREDTH))
def test_a_known_lamp_measures_the_readout_time_whatever_the_times_are_rounded_to(
    resolution: float,
) -> None:
    truth = replace(FILM, resolution=resolution)
    clock = JudgedClock(truth, True, truth.phases(lamp_known()).fit_clocks())
    assert clock.is_sure
    for name in ("switching_frequency", "readout_time", "gap", "frame_period"):
        assert abs(clock.off(name)) < 4.0
    assert clock.clock.fits[0].values.readout_time.error < 1e-4 * READOUT


@each_case((0.0, 0.03, -0.03, 0.049))
def test_a_wrong_guess_of_the_readout_time_never_gives_one_wrong_answer(off: float) -> None:
    known = KnownTiming(1.7 * LAMP, (1.0 + off) * READOUT)
    clock = FILM.phases(known).fit_clocks()
    frequencies = [each.values.switching_frequency.value for each in clock.fits]
    assert len(frequencies) > 1
    assert min(abs(one - LAMP) for one in frequencies) < 0.01
    # Every whole number of cycles in a frame period: 60 half cycles a second.
    assert np.diff(sorted(frequencies)) == pytest.approx(60.0, abs=0.01)


def test_a_stated_frequency_is_preferred_to_a_guessed_readout_time() -> None:
    clock = FILM.phases(KnownTiming(LAMP, 1.034 * READOUT)).fit_clocks()
    assert clock.fits[0].values.switching_frequency.value == pytest.approx(LAMP, rel=1e-5)


def test_an_oscillator_of_two_percent_leaves_all_lamps_that_fit() -> None:
    known = lamp_known(0.985 * LAMP, 0.02)
    clock = replace(FILM, readout=27e-6).phases(known).fit_clocks()
    found = sorted(each.values.switching_frequency.value for each in clock.fits)
    assert found == pytest.approx([LAMP - 60.0, LAMP], rel=2e-4)


@each_case((1, 2, 4, 8))
def test_a_known_lamp_shows_slow_motion(slow_motion: int) -> None:
    rate = 30.0 * slow_motion
    readout = 0.8 / rate / COLUMNS
    truth = FilmTruth(1940.0, readout, 1.0 / rate, 90, 2.0, slow_motion=slow_motion)
    clock = truth.phases(lamp_known(1940.0 * 1.00005)).fit_clocks()
    assert [each.values.slow_motion for each in clock.fits] == [slow_motion]
    values = clock.fits[0].values
    assert abs(values.readout_time.value - readout) < 4.0 * values.readout_time.error
    assert abs(values.frame_period.value - 1.0 / rate) < 4.0 * values.frame_period.error


def test_slow_motion_that_the_lamp_cannot_tell_leaves_the_readout_time_sure() -> None:
    """33 1/3 cycles of 1 kHz in 1/30 s and 8 1/3 in 1/120 s end at the same phase."""
    readout = 0.8 / 120 / COLUMNS
    phases = FilmTruth(LAMP, readout, 1 / 120, 90, 2.0, slow_motion=4).phases(lamp_known())
    clocks = phases.fit_clocks()
    assert [each.values.slow_motion for each in clocks.fits] == [1, 4]
    clock = describe_clock(clocks, phases, phases.times.parts[0], 2)
    assert not clock.is_sure
    assert clock.is_sure_of("readout_time")
    assert clock.is_sure_of("switching_frequency")
    assert not clock.is_sure_of("frame_period")
    assert not clock.is_sure_of("gap")


def test_times_that_hide_the_clock_are_named_as_the_reason() -> None:
    """Uneven frames whose times are kept to ten cycles of the lamp."""
    truth = replace(FILM, resolution=HUNDREDTH, jitter=0.03, frames=200)
    clock = truth.phases(KnownTiming(LAMP, READOUT)).fit_clocks()
    assert clock.fits == ()
    assert "their times are kept to 10 ms only, in which what is sent repeats 9." in clock.reason


def test_a_readout_longer_than_the_frame_period_is_named_as_the_reason() -> None:
    truth = replace(FILM, readout=2.0 * READOUT)
    clock = truth.phases(KnownTiming(LAMP, 2.0 * READOUT)).fit_clocks()
    assert clock.reason.startswith("1000 columns cannot be read out within a frame period of 33.3")


def test_exact_uneven_times_are_used_as_they_are() -> None:
    truth = replace(FILM, jitter=0.002)
    clock = JudgedClock(truth, False, truth.phases(KnownTiming(LAMP, READOUT)).fit_clocks())
    assert [each.is_by_number for each in clock.clock.fits] == [False]
    assert abs(clock.off("switching_frequency")) < 4.0


@each_case(product(RESOLUTIONS, KNOWN))
def test_stated_errors_hold_in_every_container(container: str, known: str) -> None:
    judged = [*judge_clocks(container, known, amount(10, 600), seed=2)]
    found = [one for one in judged if one.clock.fits]
    assert len(found) >= 0.5 * len(judged)  # jitter hides some fast lamps
    assert all(one.is_listed for one in found)
    sure = [one for one in found if one.is_sure]
    for name in ("switching_frequency", "readout_time", "gap"):
        off = np.abs([one.off(name) for one in sure])
        assert off.max() < 5.0
        assert np.mean(off < 2.0) > amount(0.6, 0.9)


@each_case((0.0, MILLISECOND))
def test_two_cameras_of_one_code_give_the_offset_of_their_times(resolution: float) -> None:
    """The second one is another camera, which begins 0.4 s and half a frame later."""
    random, off = np.random.default_rng(4), []
    for seed in range(amount(12, 100)):
        later = float(random.uniform(0.3, 0.5))
        first = replace(FILM, period=52.0, frequency=8e3, resolution=resolution, seed=seed)
        second = replace(first, readout=20e-6, frame_period=1 / 50, frames=90)
        clocks = []
        for truth, starts in ((first, 0.0), (second, later)):
            film = truth.phases(KnownTiming(8e3, truth.readout))
            begin = np.random.default_rng(seed).uniform(0.0, 1.0)  # as the truth's films do
            places = np.mod(film.phases.places + (starts - begin) * 8e3, 52.0)
            film = replace(film, phases=replace(film.phases, places=places))
            clocks.append(describe_clock(film.fit_clocks(), film, film.times.parts[0], 0))
        offset = clocks[0].offset_of(clocks[1])
        repeat = 52.0 / 8e3
        # The second film's time is 0 when that of the first is ``later``.
        assert clocks[0].repeat_time == pytest.approx(repeat, rel=1e-3)
        off.append(((offset.value + later + repeat / 2) % repeat - repeat / 2) / offset.error)
    assert np.abs(off).max() < 4.5
    if resolution == 0.0:
        assert offset.error < 1e-6
