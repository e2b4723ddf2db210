"""Parts of the sequence detector, and the words of schemes with their run limits."""

import sys
from itertools import groupby, product
from types import FrameType
from typing import Any

import numpy as np
import pytest
from physics.exposed_chips import expose_rows, noise_of

import occ_model as occ
from occ_model.receiver.light import PER_CHIP, expected_light, light_of_chips
from occ_model.receiver.sequence import decoder
from occ_model.receiver.sequence.beam import search_beam
from occ_model.receiver.sequence.code_words import find_code_words, words_of_runs
from occ_model.receiver.sequence.exposures import RowTiming, gather
from occ_model.receiver.sequence.fit import Brightness, SequenceFit, guess_brightness, improve
from occ_model.receiver.sequence.search import Chips, find_all_best_chips
from occ_model.receiver.sequence.trellis import FREE_CHIPS, make_trellis, steps_from_places
from occ_model.scene.scene import Scene

RANDOM = np.random.default_rng(12)
SENT = RANDOM.integers(0, 2, 120).astype(np.uint8)


def test_few_paths_find_the_chips_of_the_whole_trellis_with_a_margin_each() -> None:
    timing = RowTiming(2.3, 0.2, 0.13)
    light = expose_rows(SENT, 2.3, 0.2, 0.13)
    seen = gather(light + noise_of(20) * RANDOM.standard_normal(len(light)), timing)
    found = search_beam(FREE_CHIPS, timing.memory, seen)
    (whole,) = find_all_best_chips(make_trellis(FREE_CHIPS, timing.memory), [seen])
    assert len(found.margins) == len(found.values)
    assert (found.margins >= 0.0).all()
    shift = whole.first - found.first
    inside = slice(10, 100)
    values = found.values[shift:][: len(whole.values)]
    assert np.array_equal(values[inside], whole.values[inside])
    # No path that was kept is closer than the closest of all.
    margins = found.margins[shift:][: len(whole.values)]
    assert (margins[inside] >= whole.margins[inside] - 1e-9).all()


@pytest.mark.parametrize("exposure", [1e-9, 0.7, 2.3])
def test_the_last_chip_is_the_last_one_that_a_row_shows(exposure: float) -> None:
    timing = RowTiming(exposure, 0.2, 0.13)
    seen = gather(np.zeros(50), timing)
    last = int(np.floor(0.13 + 49 * 0.2 + exposure))
    assert seen.first + len(seen.energy) - 1 == last
    (found,) = find_all_best_chips(make_trellis(FREE_CHIPS, timing.memory), [seen])
    assert found.first + len(found.values) - 1 == last
    assert found.first == seen.first - timing.memory


@pytest.mark.parametrize("pattern", ["", "1000"])
def test_the_light_of_random_data_reaches_0_and_1_with_a_mean_of_a_half(pattern: str) -> None:
    light = expected_light(Scene().replace(pattern=pattern, exposure_time=5e-5))
    assert (light.min(), light.max()) == pytest.approx((0.0, 1.0))
    assert light.mean() == pytest.approx(0.5, abs=0.06)


def test_the_brightness_is_first_guessed_from_the_covariance_of_neighbouring_rows() -> None:
    light = 60.0 + 150.0 * expose_rows(SENT, 1.3, 0.35, 0.0)
    guess = guess_brightness(light, light_of_chips(SENT, 1.3), RowTiming(1.3, 0.35), PER_CHIP)
    assert guess.dark == pytest.approx(60.0, abs=1.0)
    assert guess.swing == pytest.approx(150.0, abs=1.0)


def test_the_chips_of_a_result_are_those_in_view_of_columns(small_signal: Any) -> None:
    scene, signal = small_signal
    result = decoder.read_signal(signal, scene)
    assert result.failure is None
    starts, length = result.chip_starts, result.chip_length
    assert length == pytest.approx(
        scene.transmitter.switching_period / scene.camera.readout_time, rel=1e-3
    )
    assert np.diff(starts) == pytest.approx(length)
    # A chip that ends in view began at most one chip earlier.
    assert -length < starts[0] <= 0.0
    assert len(signal) - length <= starts[-1] < len(signal)
    assert len(result.chips) == len(starts) == len(result.chip_likelihoods)
    assert result.correlation > 0.9
    assert result.light is not None
    assert result.light_model is not None
    expected = np.corrcoef(result.light, result.light_model)[0, 1]
    assert result.correlation == pytest.approx(expected)


@pytest.fixture(scope="module")
def small_signal() -> tuple[Scene, np.ndarray]:
    scene = occ.load_preset("phone-68us").replace(rows=60, panel_height=2.0)
    region = occ.decode(occ.render(scene).image, scene, "sequence")
    assert region.signal is not None
    return scene, region.signal


def count_improvements(signal: np.ndarray, scene: Scene) -> int:
    """Count how often a reading improves timing and brightness, and detects the chips again."""
    calls = 0

    def count(frame: FrameType, event: str, _argument: object) -> None:
        nonlocal calls
        calls += event == "call" and frame.f_code is improve.__code__

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        occ.decode(signal, scene, "sequence")
    finally:
        sys.setprofile(before)
    return calls


def test_chips_are_detected_again_as_long_as_it_helps() -> None:
    scene = occ.load_preset("phone-68us").replace(enhancement="none")
    signal = occ.column_profile(scene)
    assert count_improvements(signal, scene) == 1  # finds the same chips
    noise = np.random.default_rng(1).normal(100.0, 30.0, len(signal))
    assert 1 < count_improvements(noise, scene) < 4  # finds others that explain hardly more
    # Chips that explain too little are improved further, at most four times and at two timings.
    assert count_improvements(signal, scene.replace(switching_frequency=10.02e3)) == 2
    assert 12 < count_improvements(signal[::-1], scene) <= 20


def fit_with(residual: np.ndarray) -> SequenceFit:
    count = len(residual)
    chips = Chips(0, np.zeros(10, dtype=np.uint8), np.ones(10))
    brightness = Brightness(np.zeros(count), np.ones(count))
    return SequenceFit(chips, RowTiming(3.0, 0.25, 0.0), brightness, np.zeros(count), residual)


def test_independent_noise_averages_out_in_sums_and_equal_errors_add_up() -> None:
    noise = RANDOM.normal(size=6000)
    white, alike = fit_with(noise), fit_with(np.repeat(noise[:1500], 4))
    assert white.noise == pytest.approx(1.0, rel=0.1)
    assert white.noise_of_sums() == pytest.approx(white.noise, rel=0.2)
    # The sum of four equal rows has sixteen times the variance of one row.
    assert alike.noise_of_sums() / alike.noise == pytest.approx(4.0, rel=0.15)
    assert white.ratios() == pytest.approx(1.0 / (2.0 * white.noise_of_sums()))
    assert white.unexplained() < 0.06
    assert fit_with(noise + 9.0).unexplained() == pytest.approx(white.unexplained())
    assert alike.unexplained() > 0.6


@pytest.mark.parametrize(("columns", "is_refused"), [(90, True), (300, False)])
def test_less_than_a_packet_is_refused_if_packets_have_a_fixed_length(
    columns: int, is_refused: bool
) -> None:
    scene = occ.load_preset("phone-68us").replace(switching_frequency=25e3)  # five columns per chip
    signal = occ.column_profile(scene)[:columns]
    said = occ.decode(signal, scene, "sequence").failure or ""
    assert said.startswith(f"Less than one packet: {columns // 5} of 24 chips") is is_refused
    raw = scene.replace(pattern="0110")
    assert "Less than" not in occ.decode(signal, raw, "sequence").failure


@pytest.mark.parametrize("line_code", ["nrz", "differential-manchester", "8b10b"])
def test_headers_lead_only_between_states_of_the_encoder(line_code: str) -> None:
    found = find_code_words(
        Scene().replace(line_code=line_code, framing="preamble").transmitter, memory=6
    )
    headers = [word for word in found.words if word.chips == found.header]
    blocks = [word for word in found.words if word.chips != found.header]
    states = {word.start_state for word in blocks}
    assert found.header
    assert {word.end_state for word in blocks} <= states
    # After a header the encoder may be in any state, as a frame may continue from any.
    assert {(word.start_state, word.end_state) for word in headers} == set(product(states, states))


@pytest.mark.parametrize("longest", [1, 2, 3])
def test_words_of_limited_runs_allow_exactly_the_sequences_without_longer_runs(
    longest: int,
) -> None:
    steps = steps_from_places(words_of_runs(longest))

    def can_be_sent(chips: tuple[int, ...]) -> bool:
        places = set(range(len(steps)))
        for chip in chips:
            places = {to for place in places for sent, to in steps[place] if sent == chip}
        return bool(places)

    for chips in product((0, 1), repeat=6):
        runs = [len(list(run)) for _, run in groupby(chips)]
        assert can_be_sent(chips) == (max(runs) <= longest), chips
