"""Figures of a match have limits; what repeats in its residual is named."""

import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from occ_model.errors import distinct_texts
from occ_model.photo.evidence.doubts import _harmonics, doubts, strongest_line
from occ_model.photo.fit.timing import Timing

PLACE, HEIGHT = np.arange(1500), np.full(1500, 100.0)
NOISE = np.random.default_rng(5).standard_normal(1500)


def explained(
    left: Any = NOISE, was_read: bool = False, saturated: float = 0.0, **other: float
) -> list[str]:
    """Return the doubts of chips that are explained well but for what is left, or some figure."""
    known = {"periods": 9.0, "exposure": 0.5, "correlation": 0.99, "information": 900.0, **other}
    timing = Timing(0.1, known["exposure"], 0.0, 2.2)
    found: Any = SimpleNamespace(
        chips=np.array([1, 1, 1, 0, 1, 0, 0, 1, 0, 0], dtype=np.uint8),
        was_read=was_read, read_again=False, periods=known["periods"],
        information=known["information"], residual=lambda profile: profile - HEIGHT,
        fit=SimpleNamespace(swing=HEIGHT, timing=timing, correlation=known["correlation"]),
    )  # fmt: skip
    stripes: Any = SimpleNamespace(profile=HEIGHT + left, saturated=saturated, period=None)
    return doubts(found, stripes, known.get("rows_alike", 1.0))


@pytest.mark.parametrize(
    ("name", "sure", "doubtful", "said", "was_read"),
    [
        ("periods", 1.5, 1.49, "Only 1.49 periods of 10 chips are in view; at least 1.50", False),
        ("periods", 3.0, 2.96, "Only 2.96 periods of 10 chips are in view; at least 3.00", True),
        ("exposure", 3.2, 3.3, "The exposure is 3.3 times as long as a chip; above 3.2", False),
        ("correlation", 0.9, 0.89, "The correlation is 0.89; below 0.90", False),
        ("information", 40.0, 39.0, "by chance by 39 bits only; at least 40", False),
        ("information", 100.0, 99.0, "by chance by 99 bits only; at least 100", True),
        ("rows_alike", 0.85, 0.84, "only with a correlation of 0.84; at least 0.85", False),
        ("saturated", 0.5, 0.51, "51.0 % of the pixels are white", True),
    ],
)
def test_each_figure_has_a_limit_from_which_a_match_is_doubtful(
    name: str, sure: float, doubtful: float, said: str, was_read: bool
) -> None:
    assert explained(was_read=was_read, **{name: sure}) == []
    (why,) = explained(was_read=was_read, **{name: doubtful})
    assert said in why


@pytest.mark.parametrize(
    ("height", "noise", "is_doubted"), [(0.05, 0.1, True), (0.015, 0.1, False), (0.05, 8.0, False)]
)
def test_a_residual_that_repeats_makes_a_match_doubtful(
    height: float, noise: float, is_doubted: bool
) -> None:
    """As the cycles of a dimmed lamp do where the ripple of the mains was taken for its stripes."""
    wave = 100.0 * height * np.sin(2.0 * np.pi * PLACE / 8.7)
    said = explained(wave + noise * NOISE)
    assert len(said) == is_doubted
    for why in said:
        period, percent = re.search(r"repeats after (.+) columns, by (.+) % of their", why).groups()
        assert float(period) == pytest.approx(8.7, rel=0.01)
        assert float(percent) == pytest.approx(5.0, rel=0.1)


@pytest.mark.parametrize("amplitude", [0.03, 0.1])
def test_a_line_in_noise_has_its_period_and_amplitude(amplitude: float) -> None:
    random, place = np.random.default_rng(3), np.arange(1500)
    wave = 100.0 * amplitude * np.sin(2.0 * np.pi * place / 12.5)
    line = strongest_line(wave + random.standard_normal(1500), np.full(1500, 100.0), 97.0, 10)
    assert line.period == pytest.approx(12.5, rel=0.01)
    assert line.amplitude == pytest.approx(amplitude, rel=0.1)
    assert line.above_noise > 50.0
    assert line.fraction > 0.15


def test_noise_has_no_line_and_a_patterns_own_are_left_out() -> None:
    random, place = np.random.default_rng(4), np.arange(1500)
    noise, swing = random.standard_normal(1500), np.full(1500, 100.0)
    only_noise = strongest_line(noise, swing, 97.0, 10)
    own = strongest_line(noise + 9.0 * np.sin(2.0 * np.pi * place / 9.7), swing, 97.0, 10)
    of_three_harmonics = strongest_line(noise, swing, 6.0, 2)
    for line in (only_noise, own, of_three_harmonics):
        assert line.above_noise < 50.0
    assert strongest_line(np.zeros(1500), swing, 97.0, 10) is None


@pytest.mark.parametrize("chip", [3.87, 3.98, 4.26])
def test_sharp_edges_between_columns_leave_no_single_line(chip: float) -> None:
    """Harmonics of more than half a cycle a column are folded to others by the sampling."""
    chips, columns = np.array([1, 1, 0, 1, 0, 0, 0, 1, 0, 1]), 1500
    seen = [
        chips[((np.arange(columns) + late) / chip % 10).astype(int)].astype(float)
        for late in (0.0, 0.3)
    ]
    noise = np.random.default_rng(6).standard_normal(columns)
    residual = 100.0 * (seen[1] - seen[0]) + noise
    line = strongest_line(residual, np.full(columns, 100.0), 10 * chip, 10)
    assert line.fraction < 0.15


@pytest.mark.parametrize(
    ("value", "limit", "texts"),
    [
        (10.04, 3.0, ("10.0", "3.0")),
        (3.54, 3.52, ("3.54", "3.52")),
        (3.500_04, 3.5, ("3.50004", "3.50000")),
    ],
)
def test_a_number_and_its_limit_are_written_apart(
    value: float, limit: float, texts: tuple[str, str]
) -> None:
    assert distinct_texts(value, limit) == texts


def test_a_harmonic_may_be_as_strong_as_four_of_its_strongest_neighbour() -> None:
    power = np.zeros(110)
    power[10::10] = np.arange(1.0, 11.0)
    harmonics = _harmonics(power, 10.0, own=2)
    assert harmonics[:2] == [(10, np.inf), (20, np.inf)]
    assert harmonics[5] == (60, 4.0 * 10.0)  # of the second, third, ninth and tenth
    assert harmonics[9] == (100, 4.0 * 7.0)
