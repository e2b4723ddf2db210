"""Which chips are read from a photo, which are fitted again, and which others explain it best."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.photo.evidence import candidates
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.evidence.other_codes import _others, _responses, nearest_other
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.camera_response import CameraTone
from occ_model.photo.fit.chips_of_harmonics import ReadPattern
from occ_model.photo.fit.timing import Timing
from occ_model.transmitter.packet import sent_chips
from occ_model.transmitter.waveform import Waveform

SENT = np.array([1, 0, 0, 1, 1, 0], dtype=np.uint8)
OTHER = np.array([1, 0, 0, 0, 1, 0], dtype=np.uint8)
AGAIN = np.array([1, 1, 1, 0, 1, 0], dtype=np.uint8)


class Reading:
    """Notes how stripes are read, and which chips are fitted, each with a correlation."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, correlation: float) -> None:
        self.how: dict[str, Any] = {}
        self.fitted: list[list[int]] = []
        self.correlation = correlation

        def read(*_: object, **how: object) -> list[ReadPattern]:
            self.how = how
            return [pattern(np.roll(SENT, 2)), pattern(OTHER)]

        monkeypatch.setattr(candidates, "read_patterns", read)
        monkeypatch.setattr(candidates, "read_otherwise", lambda *_: [pattern(AGAIN)])
        monkeypatch.setattr(candidates, "replace", lambda one, **changes: one)
        monkeypatch.setattr(Candidates, "_fitted_read", lambda _, read: self._fit(read))

    def _fit(self, read: list[ReadPattern]) -> list[Any]:
        self.fitted += [one.chips.tolist() for one in read]
        fit = SimpleNamespace(correlation=self.correlation)
        return [SimpleNamespace(fit=fit, chips=one.chips) for one in read]

    def of(self, as_sent: Any, saturated: float = 0.0, period: float | None = 60.0) -> int:
        """Read, and give the number of hypotheses."""
        line = np.zeros(10)
        stripes: Any = SimpleNamespace(
            period=period, profile=line, flattened=line, saturated=saturated
        )
        made = Candidates(stripes, occ.Scene(), [], False, "readout_time", None, lambda: None)
        return len(made.read(as_sent))


def pattern(chips: np.ndarray) -> ReadPattern:
    return ReadPattern(chips, 0.9, 0.5, 0.0)


def sent(correlation: float, information: float) -> Any:
    fit = SimpleNamespace(correlation=correlation)
    return SimpleNamespace(fit=fit, information=information, chips=SENT)


def test_chips_that_are_explained_well_are_not_fitted_again_however_they_are_turned(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    reading = Reading(monkeypatch, 0.5)
    assert reading.of(sent(0.99, 10.0)) == 1
    assert reading.fitted == [OTHER.tolist()]


@pytest.mark.parametrize("as_sent", [None, sent(0.9, 10.0)])
@pytest.mark.parametrize(("correlation", "count"), [(0.9, 3), (0.99, 2)])
def test_where_nothing_explains_the_stripes_well_chips_are_read_otherwise_too(
    monkeypatch: pytest.MonkeyPatch, as_sent: Any, correlation: float, count: int
) -> None:
    reading = Reading(monkeypatch, correlation)
    assert reading.of(as_sent) == count
    assert (AGAIN.tolist() in reading.fitted) == (count == 3)
    assert reading.fitted[:2] == [np.roll(SENT, 2).tolist(), OTHER.tolist()]


@pytest.mark.parametrize(
    ("as_sent", "is_sure"),
    [
        (sent(0.99, 150.0), True),
        (sent(0.99, 50.0), False),
        (sent(0.9, 150.0), False),
        (None, False),
    ],
)
def test_nothing_is_read_where_the_chips_given_are_sure(
    monkeypatch: pytest.MonkeyPatch, as_sent: Any, is_sure: bool
) -> None:
    assert (Reading(monkeypatch, 0.99).of(as_sent) == 0) == is_sure


@pytest.mark.parametrize(("fraction", "is_clipped"), [(0.0, False), (0.01, False), (0.3, True)])
def test_white_pixels_are_told_to_who_reads(
    monkeypatch: pytest.MonkeyPatch, fraction: float, is_clipped: bool
) -> None:
    reading = Reading(monkeypatch, 0.99)
    reading.of(None, fraction)
    assert reading.how["is_clipped"] == is_clipped


def test_stripes_that_do_not_repeat_are_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    assert Reading(monkeypatch, 0.99).of(None, period=None) == 0


def test_other_chips_are_as_many_a_second_as_those_they_replace(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A dimmed lamp's 25 chips take the time of two: their readout time is 12.5 times smaller."""
    monkeypatch.setattr(candidates, "nearest_other", lambda *_: OTHER)
    fit: Any = SimpleNamespace()
    explained = Explanation(OTHER, (fit,), CameraTone("light", "none", lambda lit, _: lit))
    monkeypatch.setattr(candidates, "explain_from", lambda *_: explained)
    stripes: Any = SimpleNamespace(profile=np.zeros(10))
    made = Candidates(stripes, occ.Scene(), [], False, "readout_time", None, lambda: None)
    found: Any = SimpleNamespace(bits=1.0, rate=12.5, fit=SimpleNamespace(timing=None))
    other = made.nearest_other(found)
    assert other.rate == 12.5


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
    made = Candidates(stripes, occ.Scene(), [], False, "readout_time", None, lambda: None)
    packet = sent_chips(occ.Scene().replace(code=345).transmitter)
    assert made._named(packet) == "the code 0101011001"
    assert made._named(packet[1:]) == f"{len(packet) - 1} chips"
