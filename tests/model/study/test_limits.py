"""Laws of the limits found by simulation."""

import errno
import math
import threading
from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from amount import amount
from hypothesis import HealthCheck, given, settings as hypothesis_settings, strategies as st
from model.study.conftest import Decoding, correct_within, replace_reading
from worker_calls import PickledJobs

import occ_model as occ
from occ_model.parallel.job import WorkerThread
from occ_model.parallel.process_pool import ProcessPool
from occ_model.results.limits import RangeEnd, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study import theory
from occ_model.study.limits import advice_of, limits_of
from occ_model.study.range_end import END_RATIO
from occ_model.study.value_images import FEW_IMAGES
from occ_model.study.working_range import STEP, working_range

SCENE = Scene()


def search_range(scene: Scene, name: str = "switching_frequency", **how: Any) -> WorkingRange:
    settings = RateSettings(how.get("images", 3), ("threshold",), how.get("seed", 1))
    return working_range(scene, name, how.get("rate", 90.0), settings)


def ends(range_end: RangeEnd) -> tuple[float, float]:
    return range_end.works.value, range_end.fails.value


@hypothesis_settings(
    max_examples=amount(10, 60), suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(low=st.floats(600.0, 40e3), ratio=st.floats(1.2, 2.0), own=st.floats(500.0, 100e3))
def test_both_ends_of_an_interval_are_found(
    decoding: Decoding, low: float, ratio: float, own: float
) -> None:
    high = low * ratio
    decoding(correct_within((low, high)))
    found = search_range(SCENE.replace(switching_frequency=own), images=20, rate=99.0)
    for range_end, truth in ((found.lowest, low), (found.highest, high)):
        works, fails = ends(range_end)
        assert min(works, fails) <= truth <= max(works, fails)
        assert low <= works <= high
        first, last = sorted(range_end.interval)
        assert first / END_RATIO <= truth <= last * END_RATIO
        assert last / first <= END_RATIO**2
        assert range_end.value == range_end.interval[0]


@pytest.mark.parametrize("own", [700.0, 5e3, 40e3])
def test_both_ends_of_the_widest_interval_and_of_the_scenes_own_one_are_exact(
    decoding: Decoding, own: float
) -> None:
    truth = [(600.0, 1e3), (2e3, 8e3), (25e3, 60e3)]
    widest = truth[1]
    decoding(correct_within(*truth))
    found = occ.limits(SCENE.replace(switching_frequency=own), images=1).frequency
    assert len(found.intervals) == len(truth)
    for interval, (low, high) in zip(found.intervals, truth, strict=True):
        assert interval.lowest.value <= interval.highest.value
        is_exact = low <= own <= high or (low, high) == widest
        for range_end, wanted in ((interval.lowest, low), (interval.highest, high)):
            works, fails = ends(range_end)
            assert min(works, fails) <= wanted <= max(works, fails)
            assert (range_end.interval is not None) == is_exact
    assert found.own.rate == 100.0
    # No gap lies between the ends that are stated first.
    assert widest[0] <= found.lowest.value < found.highest.value <= widest[1]
    assert found.others == (found.intervals[0], found.intervals[2])


def test_an_end_is_found_with_images_that_were_not_used_to_choose_it(decoding: Decoding) -> None:
    # Reading ends at 12 kHz in the images used to choose the end, and at 11 kHz in all others.
    decoding(lambda frequency, _, seed: frequency <= (12e3 if seed == 1 else 11e3))
    range_end = occ.limits(SCENE, images=20).frequency.highest
    works, fails = ends(range_end)
    assert works <= 11e3 < fails <= 12e3
    assert (range_end.works.rate, range_end.fails.whole) == (100.0, 0)


def test_a_range_that_reaches_the_search_limit_states_it(decoding: Decoding) -> None:
    decoding(correct_within((0.0, math.inf)))
    found = occ.limits(SCENE.replace(switching_frequency=3e6), images=1)
    assert found.frequency.searched == (500.0, 3e6)
    assert found.highest_frequency == 3e6
    for searched in (found.frequency, found.exposure):
        for range_end in (searched.lowest, searched.highest):
            assert (range_end.fails, range_end.interval) == (None, None)
            assert range_end.value in searched.searched
    assert (found.shortest_exposure, found.longest_exposure) == found.exposure.searched


def test_if_nothing_is_read_a_sentence_states_it(decoding: Decoding) -> None:
    decoding(correct_within())
    found = occ.limits(SCENE, "matched", rate=75.0, images=2)
    assert found.highest_frequency is found.shortest_exposure is found.longest_exposure is None
    assert found.frequency.failure == (
        "The matched decoder reads 75 % of the bits at no switching frequency from 500 Hz to "
        "100 kHz; the most it reads is 10 of 20 bits, at 500 Hz."
    )
    assert (found.frequency.best.value, found.frequency.best.right) == (500.0, 10)
    assert found.frequency.lowest is None


def test_the_papers_decoder_reads_from_two_packets_to_the_null() -> None:
    scene = occ.load_preset("phone-136us")
    found = search_range(scene, images=20)
    works, fails = ends(found.highest)
    null = theory.null_frequency(scene)
    # Below the null, equalizing the weak stripes amplifies the noise.
    assert 0.95 * null < works < fails < 1.01 * null
    least = theory.two_packets_frequency(scene)
    assert 0.7 * least < found.lowest.value < 1.1 * least
    longest = search_range(scene, "exposure_time", images=1).highest
    null_exposure = 2.0 / scene.transmitter.switching_frequency
    assert 0.95 * null_exposure < longest.value < 1.01 * null_exposure


def test_a_value_is_given_up_once_further_images_cannot_reach_the_rate(decoding: Decoding) -> None:
    read = decoding(lambda frequency, *_: frequency < 20e3)
    range_end = occ.limits(SCENE, images=20).frequency.highest
    by_frequency: Counter[float] = Counter()
    for (frequency, _), images in read.items():
        by_frequency[frequency] += images
    far = {images for frequency, images in by_frequency.items() if frequency > 21e3}
    assert far == {1}
    # What is reported rests on all images: no count has been stopped by its own result.
    assert min(range_end.works.images, range_end.fails.images) >= 20


def test_no_image_is_simulated_twice(decoding: Decoding, monkeypatch: pytest.MonkeyPatch) -> None:
    read: Counter[tuple[float, int, int]] = Counter()

    # The rate falls slowly, so all values are uncertain.
    def falling(frequency: float, image: int, seed: int) -> float:
        read[frequency, image, seed] += 1
        return float(image % 20 >= (frequency - 10e3) / 2e3)

    decoding(falling)
    search_range(SCENE.replace(switching_frequency=5e3), images=20)
    assert max(read.values()) == 1


def test_few_images_suffice_if_the_rate_falls_abruptly(decoding: Decoding) -> None:
    read = decoding(lambda frequency, *_: 4e3 <= frequency <= 20e3)
    search_range(SCENE, images=20, rate=99.0)
    by_seed: Counter[bool] = Counter()
    for (_, seed), images in read.items():
        by_seed[seed == 1] += images
    assert by_seed[True] < 1 * 103 + FEW_IMAGES * 50  # of a scan of 150 values, 47 of them read
    assert by_seed[False] < 2 * 250


TWO = RateSettings(2, ("threshold", "matched"), 1)


class ThreadAsProcess(WorkerThread):
    def __init__(self, count: int, preload: str) -> None:
        super().__init__()


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_limits_of_a_decoder_are_known_before_the_next_one_has_read(
    monkeypatch: pytest.MonkeyPatch, jobs: int
) -> None:
    monkeypatch.setattr("occ_model.parallel.process_pool.ProcessPool", ThreadAsProcess)
    may_read = threading.Event()

    def read(_scene: Scene, settings: RateSettings, *_: object, first: int) -> Iterator[tuple[int]]:
        assert settings.decoders == ("threshold",) or may_read.wait(10.0)
        yield from [(10,)] * (settings.images - first)

    replace_reading(monkeypatch, read)
    found = limits_of(SCENE, TWO, 60.0, jobs=jobs)
    assert next(found).decoder == "threshold"
    may_read.set()
    assert [limits.decoder for limits in found] == ["matched"]


class NoProcesses(PickledJobs):
    lost_by = ProcessPool.lost_by

    def __init__(self, count: int, preload: str) -> None:
        raise OSError(errno.EROFS, "no semaphores")


class DyingAtExposures(PickledJobs):
    deadly = ("exposure_time",)


@pytest.mark.parametrize("processes", [PickledJobs, DyingAtExposures, NoProcesses])
def test_limits_do_not_depend_on_who_searches(
    decoding: Decoding, monkeypatch: pytest.MonkeyPatch, processes: type[PickledJobs]
) -> None:
    monkeypatch.setattr("occ_model.parallel.process_pool.ProcessPool", processes)
    decoding(correct_within((2e3, 20e3)))
    alone = [occ.limits(SCENE, name, rate=60.0, images=2) for name in TWO.decoders]
    assert list(limits_of(SCENE, TWO, 60.0, jobs=2)) == alone


def test_progress_rises_from_0_to_1_and_states_what_is_searched(decoding: Decoding) -> None:
    decoding(correct_within((0.0, 20e3)))
    said: list[tuple[float, str]] = []
    occ.limits(SCENE, images=20, progress=lambda fraction, what: said.append((fraction, what)))
    fractions = [fraction for fraction, _ in said]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    assert len(said) > 60
    searched = [what for _, what in said[:-1]]
    assert searched[0] == "switching frequency, threshold decoder"
    assert searched.index("exposure time, threshold decoder") > 20


def test_for_a_scene_that_is_too_slow_the_range_lies_above_it() -> None:
    """The tablet at 2 kHz and 2 m, where too few packets fit into the picture."""
    slow = occ.load_preset("tablet-122us").replace(switching_frequency=2e3, distance=2.0)
    assert occ.success_rate(slow, 3) < 99.0
    found = search_range(slow, images=1)
    assert found.lowest.value > 2e3 * STEP
    null = theory.null_frequency(slow)
    assert 0.93 * null < found.highest.value < 1.01 * null


def test_advice_contains_both_ends_found_and_the_limits_of_theory(decoding: Decoding) -> None:
    decoding(correct_within((0.0, 20e3)))
    found = occ.limits(SCENE, images=1)
    advice = advice_of(found)
    lowest = advice.limits.frequency.lowest
    assert lowest is not None
    assert (lowest.value, lowest.fails) == (500.0, None)
    # At the longest exposure that theory allows, the scene's own frequency is theory's limit.
    exposures = advice.exposure
    for exposure, limit in (
        (exposures.band_model, theory.band_model_frequency),
        (exposures.null, theory.null_frequency),
    ):
        own = SCENE.transmitter.switching_frequency
        assert limit(SCENE.replace(exposure_time=exposure)) == pytest.approx(own)


def test_no_number_of_images_proves_that_all_are_read(decoding: Decoding) -> None:
    decoding(correct_within((0.0, 20e3)))
    range_end = occ.limits(SCENE, rate=100.0).frequency.highest
    assert range_end.interval is None
    assert not range_end.is_sure
    assert range_end.value <= 20e3 < range_end.fails.value <= 20e3 * END_RATIO


def test_an_end_of_a_range_in_which_every_bit_is_read_is_a_value_that_was_tried() -> None:
    # Two packets hardly fit the panel, so that chance makes narrow gaps and islands.
    far = occ.load_preset("tablet-122us").replace(distance=2.4, switching_frequency=3e3)
    found = occ.limits(far, rate=100.0, images=5, seed=3).frequency
    for each in found.intervals:
        assert each.lowest.works.rate == 100.0
        assert each.lowest.value == each.lowest.works.value  # no value that was not tried


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("error", [KeyboardInterrupt, BrokenPipeError])
def test_an_exception_from_the_heartbeat_ends_the_search(
    monkeypatch: pytest.MonkeyPatch, error: type[BaseException], jobs: int
) -> None:
    monkeypatch.setattr("occ_model.parallel.process_pool.ProcessPool", ThreadAsProcess)
    beats: list[int] = []

    def stop() -> None:
        beats.append(1)
        raise error

    with pytest.raises(error):
        occ.limits(SCENE, heartbeat=stop, jobs=jobs)
    assert len(beats) == 1


def test_the_bits_of_a_payload_are_counted_as_sent() -> None:
    scene = SCENE.replace(payload="text:Hi", line_code="manchester", framing="preamble")
    end = search_range(scene, images=1).highest
    assert end.works.right == end.works.sent == 16 * end.works.images


def searches_with_a_gap(
    decoding: Decoding, in_gap: float, elsewhere: float, trials: int
) -> Iterator[bool]:
    """Yield whether a search lists a gap of 4 % that reads so much, anywhere, between others."""
    for trial in range(trials):
        random = np.random.default_rng([trial, 8])
        first = float(np.exp(random.uniform(np.log(3e3), np.log(15e3))))

        def fraction(frequency: float, image: int, seed: int, first: float = first) -> float:
            if not 1e3 <= frequency <= 20e3:
                return 0.0
            rate = in_gap if first <= frequency <= 1.04 * first else elsewhere
            key = [seed, round(frequency * 1e3), image]
            return float(np.random.default_rng(key).random() < rate)

        decoding(fraction)
        settings = RateSettings(20, ("threshold",), 100 + trial)
        found = working_range(SCENE, "switching_frequency", 99.0, settings)
        gaps = [
            (before.highest.works.value, after.lowest.works.value)
            for before, after in pairwise(found.intervals)
        ]
        yield any(low < 1.04 * first and high > first for low, high in gaps)


@pytest.mark.parametrize(("rate", "chance"), [(0.45, 0.97), (0.8, 0.67)])
def test_a_gap_of_4_percent_is_found_with_the_stated_chance(
    decoding: Decoding, rate: float, chance: float
) -> None:
    trials = amount(60, 400)
    found = sum(searches_with_a_gap(decoding, rate, 1.0, trials))
    assert found / trials > chance - 2.5 * math.sqrt(chance * (1.0 - chance) / trials)


def test_few_searches_list_a_gap_where_none_is(decoding: Decoding) -> None:
    trials = amount(20, 100)
    assert sum(searches_with_a_gap(decoding, 0.998, 0.998, trials)) <= 0.1 * trials
