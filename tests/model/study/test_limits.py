"""Laws of the limits found by simulation, and of those of theory."""

import errno
import math
import re
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from statistics import NormalDist
from typing import Any

import numpy as np
import pytest
from amount import amount
from hypothesis import HealthCheck, given, settings as hypothesis_settings, strategies as st
from worker_calls import PickledJobs

import occ_model as occ
from occ_model.camera.photometry import level_values
from occ_model.cli import main
from occ_model.parallel.job import WorkerThread
from occ_model.parallel.process_pool import ProcessPool
from occ_model.results.limits import RangeEnd, WorkingRange
from occ_model.results.sweep_request import RateSettings
from occ_model.scene.scene import Scene
from occ_model.study import theory, value_images
from occ_model.study.confidence import count_until_refuted
from occ_model.study.limits import advice_of, limits_of
from occ_model.study.observation import panel_span
from occ_model.study.range_end import END_RATIO, Bracket, EndSearch, images_to_prove
from occ_model.study.success_rate import ImageSeries
from occ_model.study.value_images import FEW_IMAGES
from occ_model.study.working_range import STEP, working_range

SCENE = Scene()


Decoding = Callable[[Callable[[float, int, int], float]], "Counter[tuple[float, int]]"]
"""Called with the fraction of correct bits as a function of frequency, image number and seed."""


def replace_reading(
    monkeypatch: pytest.MonkeyPatch, right_bits_of_images: Callable[..., Iterator[tuple[int]]]
) -> None:
    def read_ahead(
        series: list[ImageSeries], settings: RateSettings, heartbeat: object
    ) -> Iterator[list[int]]:
        for each in series:
            these = replace(settings, seed=each.seed, images=each.numbers.stop)
            right = right_bits_of_images(each.scene, these, heartbeat, first=each.numbers.start)
            yield [count for (count,) in right]

    monkeypatch.setattr(value_images, "right_bits_of_images", right_bits_of_images)
    monkeypatch.setattr(value_images, "read_ahead", read_ahead)


@pytest.fixture
def decoding(monkeypatch: pytest.MonkeyPatch) -> Decoding:
    """Replace all decoding, and count the images read by frequency and seed."""

    def replace_decoding(
        fraction: Callable[[float, int, int], float],
    ) -> "Counter[tuple[float, int]]":
        read: Counter[tuple[float, int]] = Counter()

        def right_bits_of_images(
            scene: Scene,
            settings: RateSettings,
            heartbeat: Callable[[], object],
            first: int = 0,
            **_: bool,
        ) -> Iterator[tuple[int]]:
            frequency = scene.transmitter.switching_frequency
            for image in range(first, settings.images):
                heartbeat()
                read[frequency, settings.seed] += 1
                yield (int(fraction(frequency, image, settings.seed) * scene.transmitter.bits),)

        replace_reading(monkeypatch, right_bits_of_images)
        return read

    return replace_decoding


def correct_within(*ranges: tuple[float, float]) -> Callable[[float, int, int], float]:
    """Return a decoding with all bits correct in these ranges, and half of them elsewhere."""
    return lambda frequency, *_: 1.0 if any(a <= frequency <= b for a, b in ranges) else 0.5


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


def test_the_command_states_the_bits_received_per_second(
    decoding: Decoding, capsys: pytest.CaptureFixture[str]
) -> None:
    decoding(correct_within((0.0, 20e3)))
    scene = ["--set", "columns=1000", "--set", "readout_time=40us", "--set", "bits=16"]
    command = ["limits", *scene, "--decoder", "threshold", "--images", "1", "--jobs", "1"]
    # The readout of a picture's columns takes 40 ms, so there are at most 25 pictures per second.
    for frames_a_second, bits in ((10, 160), (60, 400)):
        assert main([*command, "--fps", str(frames_a_second)]) == 0
        assert capsys.readouterr().out.splitlines()[2].endswith(f" {bits}")


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


@pytest.mark.parametrize("rate", [50.0, 90.0, 99.0, 99.5])
def test_no_more_images_are_requested_than_prove_a_rate(rate: float) -> None:
    """Whatever is lost more often than allowed would lose one of them with 95 %."""
    images = images_to_prove(rate)
    assert (rate / 100.0) ** images <= 0.05 < (rate / 100.0) ** (images - 1)


def test_no_number_of_images_proves_that_all_are_read(decoding: Decoding) -> None:
    decoding(correct_within((0.0, 20e3)))
    range_end = occ.limits(SCENE, rate=100.0).frequency.highest
    assert range_end.interval is None
    assert not range_end.is_sure
    assert range_end.value <= 20e3 < range_end.fails.value <= 20e3 * END_RATIO


def logistic(width: float) -> Callable[[float], float]:
    """Return the fraction that is lost by the logarithm of the value, 1 % of it at 0."""
    return lambda at: 1.0 / (1.0 + 99.0 * math.exp(min(-at / width, 700.0)))


LOSSES: dict[str, Callable[[float], float]] = {
    "steep": logistic(5e-4),
    "gradual": logistic(0.02),
    "straight": lambda at: min(max(0.01 + 2.0 * at, 0.0), 1.0),
    "normal": lambda at: NormalDist().cdf(NormalDist().inv_cdf(0.01) + at / 0.02),
    "half of them at once": lambda at: 0.5 * (at >= 0.0),
    "shoulder": lambda at: 1.0 if at > 0.01 else 0.03 * (at >= 0.0),
    "sudden, in part": lambda at: 0.0 if at < -0.001 else min(0.01 + 10.0 * max(at, 0.0), 0.3),
}


@pytest.mark.parametrize("name", LOSSES)
@pytest.mark.parametrize("inwards", [1.0, -1.0])
def test_the_interval_of_an_end_contains_it_in_95_of_100_searches(
    name: str, inwards: float
) -> None:
    """However losses set in; the last has a rate of 99 % exactly over a tenth of a percent."""
    loss, studies = LOSSES[name], amount(60, 400)
    held = sought = 0
    for study in range(studies):
        random = np.random.default_rng([study, 20_261, inwards > 0.0])

        def measure(
            values: Sequence[float], images: int, random: np.random.Generator = random
        ) -> list[list[float]]:
            lost = [loss(-inwards * math.log(value / 1e4)) for value in values]
            return [(random.random(images) < each).astype(float).tolist() for each in lost]

        def at(place: float) -> float:
            return 1e4 * math.exp(-inwards * place)

        place = -0.6 + random.uniform(0.0, math.log(STEP))
        while not any(measure([at(place + math.log(STEP))], FEW_IMAGES)[0]):
            place += math.log(STEP)
        bracket = Bracket(at(place), at(place + math.log(STEP)), at(-0.6), at(0.6))
        found = EndSearch(measure, 99.0, 20).find(bracket)
        if found is None:
            continue
        first, last = sorted(found.interval)
        sought += 1
        held += first <= 1e4 <= last * (1.0 + 1e-12)
    assert sought >= 0.95 * studies
    assert held >= 0.95 * sought - 2.5 * math.sqrt(0.95 * 0.05 * sought)


def test_a_rate_that_is_reached_is_rejected_in_at_most_one_of_forty_studies() -> None:
    random = np.random.default_rng(4711)

    def count_refuting_images(rate: float, studies: int) -> list[int]:
        """Return how many images each study took that rejects 99 %."""
        read = (np.where(random.random(200) < rate, 10, 0).tolist() for _ in range(studies))
        found = [count_until_refuted(counts, 10, 0.99) for counts in read]
        return [len(one) for one in found if one is not None]

    studies = amount(400, 2000)
    most = studies * 0.025
    assert 0.1 * most < len(count_refuting_images(0.99, studies)) < most + 3.0 * math.sqrt(most)
    assert len(count_refuting_images(0.95, 200)) > 140
    assert np.median(count_refuting_images(0.5, 200)) <= 4  # half of their bits are missing


def test_that_all_bits_are_read_is_refuted_by_the_first_wrong_bit() -> None:
    assert count_until_refuted([10, 10, 9, 10], 10, 1.0) == [10, 10, 9]
    assert count_until_refuted([10] * 60, 10, 1.0) is None
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


def test_at_its_limit_two_packets_just_fill_the_panels_columns() -> None:
    scene = occ.load_preset("tablet-122us")
    frequency = theory.two_packets_frequency(scene)
    span = panel_span(scene)
    chips = span.columns * scene.camera.readout_time * frequency
    assert chips == pytest.approx(2 * len(occ.packet(scene)), rel=1e-12)
    assert theory.two_packets_frequency(scene.replace(offset_x=50.0)) is None


def test_the_lit_panel_is_just_white_at_saturation_exposure() -> None:
    scene = occ.load_preset("phone-136us")
    white = theory.saturation_exposure(scene)
    assert level_values(scene.replace(exposure_time=white))[1] == pytest.approx(255.0, rel=1e-12)
    dark = scene.replace(luminance=0.0, illuminance=0.0)
    assert theory.saturation_exposure(dark) == math.inf


def test_the_command_answers_with_one_table_of_all_decoders(
    decoding: Decoding, capsys: pytest.CaptureFixture[str]
) -> None:
    decoding(correct_within((0.0, 2e3), (4e3, 14e3)))
    assert main(["limits", "--preset", "phone-136us", "--images", "2", "--jobs", "1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split("  ")[0] == "decoder"
    rows = [[cell for cell in line.split("  ") if cell] for line in lines[2:6]]
    assert [cells[0].strip() for cells in rows] == ["threshold", "matched", "equalizer", "sequence"]
    for cells in rows:
        assert cells[1].strip() == "500 Hz (not searched beyond)"
        assert re.fullmatch(r" ?(1\.9\d*|2) kHz", cells[2])
        assert re.fullmatch(r" ?from 4[.\d]* kHz to 1[34][.\d]* kHz", cells[3].rstrip())
    place = lines.index(
        "  Below 3.468 kHz a picture does not contain two packets, and not always the two "
        "headers that this decoder needs."
    )
    assert place < lines.index("The matched decoder, switching frequency:")
    assert lines[-1].endswith("; above 1.17 ms, completely lit columns are saturated.")


def test_the_commands_table_and_sentences_state_the_same_ends(
    decoding: Decoding, capsys: pytest.CaptureFixture[str]
) -> None:
    """If the rate falls slowly, more images move an end that the search has found."""

    def read_more_rarely(frequency: float, image: int, seed: int) -> float:
        lost = (frequency / 40e3) ** 2
        return float(np.random.default_rng([seed, image, int(frequency)]).random() > lost)

    decoding(read_more_rarely)
    command = ["limits", "--decoder", "threshold", "--images", "5", "--rate", "90", "--jobs", "1"]
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    highest = re.split(" {2,}", lines[2])[2]
    last_interval = lines.index("The threshold decoder, exposure time:") - 1
    assert lines[last_interval].startswith(f"  {highest}: ")


def test_the_command_fails_where_nothing_is_read(capsys: pytest.CaptureFixture[str]) -> None:
    dark = ["--set", "luminance=0", "--set", "illuminance=0"]
    assert main(["limits", "--decoder", "matched", "--images", "1", *dark]) == 1
    printed = capsys.readouterr().out
    assert "at no switching frequency from 500 Hz to 100 kHz" in printed
    assert "without light nothing saturates" in printed


def test_the_bits_of_a_payload_are_counted_as_sent() -> None:
    scene = SCENE.replace(payload="text:Hi", line_code="manchester", framing="preamble")
    end = search_range(scene, images=1).highest
    assert end.works.right == end.works.sent == 16 * end.works.images


def test_the_rate_at_the_scenes_own_values_is_that_of_its_own_code(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Few images are enough to accept a value, so a range can contain one that is misread once."""
    own = occ.load_preset("phone-68us").replace(code=5)

    def once_wrong(
        scene: Scene, settings: RateSettings, *_: object, first: int = 0, **_kept: bool
    ) -> Iterator[tuple[int]]:
        for image in range(first, settings.images):
            yield (0 if scene == own and image == 7 else 10,)

    replace_reading(monkeypatch, once_wrong)
    command = ["limits", "--set", "code=5", "--decoder", "matched", "--jobs", "1", "--fps", "20"]
    assert main(command) == 0
    lines = capsys.readouterr().out.splitlines()
    assert " sending code 5: " in lines[0]
    assert [cell.strip() for cell in lines[2].split("  ") if cell][3] == "no"
    assert (
        "  At 10 kHz it read 19 of 20 pictures of code 5, 95 % of the bits (76.4 to 99.1 %): "
        "190 bits a second, if other codes are read as well."
    ) in lines


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
