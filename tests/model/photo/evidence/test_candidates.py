"""Which chips are read from a photo, and which of them need not be fitted again."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.photo.evidence import candidates
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.camera_response import CameraTone
from occ_model.photo.fit.chips_of_harmonics import ReadPattern

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
        made = Candidates(stripes, occ.Scene(), [], False, lambda *_: 0.0, None, lambda: None)
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


@pytest.mark.parametrize(("share", "is_clipped"), [(0.0, False), (0.01, False), (0.3, True)])
def test_white_pixels_are_told_to_who_reads(
    monkeypatch: pytest.MonkeyPatch, share: float, is_clipped: bool
) -> None:
    reading = Reading(monkeypatch, 0.99)
    reading.of(None, share)
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
    made = Candidates(stripes, occ.Scene(), [], False, lambda *_: 0.0, None, lambda: None)
    found: Any = SimpleNamespace(bits=1.0, rate=12.5, fit=SimpleNamespace(timing=None))
    other = made.nearest_other(found)
    assert other.rate == 12.5
