"""The other chips that explain stripes best, by the responses of columns to each chip."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.evidence.other_codes import _others, _responses, nearest_other
from occ_model.photo.fit.timing import Timing
from occ_model.transmitter.packet import sent_chips
from occ_model.transmitter.waveform import Waveform

TIMING = Timing(0.08, 1.3, 4.2, 2.2)
COLUMNS = 400


@pytest.mark.parametrize("timing", [TIMING, Timing(0.3, 5.1, -3.0, 2.2)])
@pytest.mark.parametrize("seed", [1, 2])
def test_the_light_of_chips_is_the_sum_of_their_responses(timing: Timing, seed: int) -> None:
    chips = np.random.default_rng(seed).integers(0, 2, 14).astype(np.uint8)
    lit = _responses(timing, 14, COLUMNS) @ chips
    assert lit == pytest.approx(timing.lit_fraction(Waveform(chips), COLUMNS), abs=1e-9)


def hypothesis(chips: np.ndarray) -> Any:
    flat = np.ones(COLUMNS)
    fit = SimpleNamespace(timing=TIMING, low=40.0 * flat, swing=100.0 * flat)
    return SimpleNamespace(chips=chips, fit=fit)


@pytest.mark.parametrize("wrong", [[3], [5, 6]])
def test_chips_that_were_misread_are_set_right(wrong: list[int]) -> None:
    """One of them, or two neighbours that are exchanged."""
    chips = np.array([1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 0], dtype=np.uint8)
    profile = 40.0 + 100.0 * TIMING.lit_fraction(Waveform(chips), COLUMNS)
    read = chips.copy()
    read[wrong] ^= 1
    found = nearest_other(profile, hypothesis(read), occ.Scene().transmitter)
    assert found.tolist() == chips.tolist()


def test_of_a_packet_all_codes_are_compared_turned_about() -> None:
    scene = occ.Scene()
    right, wrong = (sent_chips(scene.replace(code=code).transmitter) for code in (345, 718))
    profile = 40.0 + 100.0 * TIMING.lit_fraction(Waveform(np.roll(right, 5)), COLUMNS)
    found = nearest_other(profile, hypothesis(wrong), scene.transmitter)
    assert found.tolist() == np.roll(right, 5).tolist()


def test_neither_the_same_chips_turned_nor_chips_without_a_change_are_others() -> None:
    chips = np.array([1, 0, 0, 0], dtype=np.uint8)
    others = _others(chips, occ.Scene().transmitter)
    assert len(others) > 2
    assert (others.min(axis=1) < others.max(axis=1)).all()
    turned = np.roll(chips, 1)
    assert turned.tolist() in others.tolist()
    profile = 40.0 + 100.0 * TIMING.lit_fraction(Waveform(turned), COLUMNS)
    found = nearest_other(profile, hypothesis(chips), occ.Scene().transmitter)
    assert sorted(found.tolist()) != sorted(chips.tolist())
    assert (
        nearest_other(np.zeros(9), hypothesis(np.zeros(5000, np.uint8)), occ.Scene().transmitter)
        is None
    )


def test_chips_are_named_by_their_code_or_by_their_number() -> None:
    stripes: Any = SimpleNamespace()
    made = Candidates(stripes, occ.Scene(), [], False, lambda *_: 0.0, None, lambda: None)
    packet = sent_chips(occ.Scene().replace(code=345).transmitter)
    assert made._named(packet) == "the code 0101011001"
    assert made._named(packet[1:]) == f"{len(packet) - 1} chips"
