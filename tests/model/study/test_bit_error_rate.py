"""Laws of the bit error rate, its interval, and the resulting bits per second."""

from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.errors import ParameterError
from occ_model.results.bit_errors import BenchPoint, table_rows
from occ_model.results.frame import Plan
from occ_model.scene.scene import Scene
from occ_model.study import success_rate
from occ_model.study.bit_error_rate import bit_errors_of, error_interval, with_payload
from occ_model.study.signals.pictures import observe_images

SCENE = occ.load_preset("phone-136us").replace(rows=60, enhancement="none")


def test_no_bit_is_wrong_if_every_code_is_read() -> None:
    found = occ.bit_error_rate(SCENE.replace(switching_frequency=8e3), bits=95)
    assert (found.bits, found.errors, found.pictures, found.pictures_right) == (100, 0, 10, 10)
    assert found.low == 0.0
    assert found.rate == 0.0


def test_all_bits_are_wrong_if_nothing_is_read() -> None:
    far = SCENE.replace(switching_frequency=2e3, distance=4.0)
    found = occ.bit_error_rate(far, "matched", bits=50)
    assert found.rate == found.high == 1.0
    assert found.bits_a_second() == found.bits_a_second_of_picture == 0.0


@pytest.mark.parametrize("luminance", [0.0, 3600.0])
def test_a_rate_above_a_half_is_explained(luminance: float) -> None:
    dark = occ.load_preset("phone-136us").replace(luminance=luminance)
    found = occ.bit_error_rate(dark, bits=30)
    point = BenchPoint("manchester", "exposure", 1.0, 20.0, found, "Its note.")
    assert bool(found.why_above_half) == (found.rate > 0.5) == (luminance == 0.0)
    assert point.explanation == f"Its note. {found.why_above_half}".strip()
    assert table_rows([point], 30.0)[0][-1] == point.explanation


def test_the_same_seed_gives_the_same_errors() -> None:
    at = SCENE.replace(switching_frequency=12.5e3)
    found = [occ.bit_error_rate(at, bits=200, seed=seed) for seed in (3, 3, 4)]
    assert found[0] == found[1]
    assert 0 < found[0].errors < 200
    assert found[0].errors != found[2].errors or found[0].low != found[2].low


@pytest.mark.parametrize("payload", ["", "text:HELLO", "bits:0110"])
def test_any_payload_is_sent_in_its_own_length(payload: str) -> None:
    sent = with_payload(SCENE.replace(payload=payload), [1, 0] * (SCENE.replace(
        payload=payload).transmitter.payload_length // 2))  # fmt: skip
    assert sent.transmitter.payload_bits[:2] == (1, 0)
    length = SCENE.replace(payload=payload).transmitter.payload_length
    assert sent.transmitter.payload_length == length


def test_errors_and_success_rate_are_complements() -> None:
    # Two ways to count the same: one payload, over many start times.
    at = SCENE.replace(switching_frequency=12.5e3, bits=2, code=0)
    wrong = occ.bit_error_rate(at, bits=100, seed=2).rate
    right = [occ.success_rate(at.replace(code=code), images=13, seed=code) for code in range(4)]
    assert 100.0 * (1.0 - wrong) == pytest.approx(np.mean(right), abs=8.0)


@pytest.mark.parametrize(("length", "fraction"), [(1, 0.02), (10, 0.1), (10, 0.02), (64, 0.3)])
def test_intervals_hold_if_bits_of_a_picture_fail_together(length: int, fraction: float) -> None:
    random = np.random.default_rng(length)
    rate, held, trials = fraction / 2.0, 0, 400
    for _ in range(trials):
        lost = random.random(200) < fraction
        wrong = np.where(lost, random.binomial(length, 0.5, 200), 0)
        low, high = error_interval(wrong.tolist(), length)
        held += low <= rate <= high
    # 95 % is nominal; the variance of few failed pictures is itself uncertain.
    assert held / trials > 0.91


def test_independent_bits_have_wilsons_interval() -> None:
    wrong = np.random.default_rng(1).binomial(100, 0.2, 5000).tolist()
    low, high = error_interval(wrong, 100)
    near = occ.wilson_interval(sum(wrong), 500_000)
    assert (low, high) == pytest.approx(near, rel=0.01)


def test_without_a_wrong_bit_each_picture_counts_as_one_trial() -> None:
    assert error_interval([0] * 40, 100) == (0.0, occ.wilson_interval(0, 40)[1])


def test_net_bits_per_second_are_whole_payloads_over_time() -> None:
    found = bit_errors_of(SCENE, "x", [0, 0, 3, 0], 3)
    assert found.bits_a_picture == 7.5
    assert found.bits_a_second(20.0) == 150.0
    shown = found.picture_time / SCENE.camera.readout_time
    assert found.bits_a_second_of_picture == pytest.approx(7.5 / (shown * 8e-6))
    assert found.gap(20.0) == pytest.approx(0.05 - 3456 * 8e-6)


def test_a_raw_pattern_has_no_bit_errors() -> None:
    with pytest.raises(ParameterError, match="raw pattern"):
        occ.bit_error_rate(SCENE.replace(pattern="01"), bits=10)


def test_a_panel_out_of_view_takes_no_time_to_read_out() -> None:
    seen = bit_errors_of(SCENE, "threshold", [0, 1], 1)
    beside = bit_errors_of(SCENE.replace(offset_x=50.0), "threshold", [10, 10], 0)
    assert seen.picture_time > 0.0
    assert beside.picture_time == 0.0
    assert beside.readout_time == seen.readout_time


def plans_of(scene: Scene, bits: int, monkeypatch: pytest.MonkeyPatch) -> list[Plan]:
    """Return the plan with which each whole picture of a measurement is simulated."""
    used: list[Plan] = []
    whole = observe_images

    def reading(images: Any, path: Any) -> Any:
        used.extend(image.plan for image in images)
        return whole(images, path)

    monkeypatch.setattr(success_rate, "observe_images", reading)
    occ.bit_error_rate(scene, bits=bits, seed=2, path="image")
    return used


def test_pictures_of_whole_packets_are_simulated_with_every_effect_that_a_payload_needs(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=60, switching_frequency=14.1e3)
    first, *others = plans_of(scene, 50, monkeypatch)
    assert all(other is first for other in others)
    alone = occ.plan(scene, observable="signal")
    assert set(alone.included) <= set(first.included)


def test_pictures_of_less_than_a_packet_are_planned_one_by_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plans = plans_of(SCENE.replace(columns=40, switching_frequency=4e3), 60, monkeypatch)
    assert len({id(one) for one in plans}) == len(plans)
