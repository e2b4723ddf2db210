"""The integral of any waveform over exposures, compared with exact rational arithmetic."""

from fractions import Fraction

import numpy as np
import pytest
from exact_light import ExactPieces

from occ_model.light.edged import EdgedWaveform
from occ_model.light.times import Duration, PhasesInPeriod, count_phases
from occ_model.light.waveform import Waveform

STARTS = 12
DECADES = (-9.0, 9.0)  # of exposure / period


class Exact(ExactPieces):
    """One period of pieces, in exact arithmetic; the unit is the mean length of a piece."""

    def __init__(self, levels: list[float], lengths: list[Fraction]) -> None:
        unit = sum(lengths, Fraction(0)) / len(lengths)
        super().__init__([*map(Fraction, levels)], [length / unit for length in lengths])
        self.count = len(levels)

    def twice_until(self, time: Fraction) -> Fraction:
        """Return the integral of the integral of the light minus its mean, times 2."""
        total, at, run = Fraction(0), Fraction(0), Fraction(0)
        rest = time % self.period
        for level, length in zip(self.levels, self.lengths, strict=True):
            part = min(length, rest - at)
            if part <= 0:
                break
            total += 2 * run * part + (level - self.mean) * part * part
            run += (level - self.mean) * part
            at += part
        return total


def pieces(random: np.random.Generator) -> tuple[list[float], list[Fraction]]:
    """Draw 2 to 500 pieces: levels of any kind, lengths equal or over many decades."""
    count = int(random.integers(2, 2 + int(10 ** random.uniform(0.0, 2.7))))
    levels = [
        random.uniform(size=count),
        random.integers(0, 2, count).astype(float),
        random.integers(0, 4, count) / 3.0,
    ][int(random.integers(3))]
    spread = (0.0, 1.0, 6.0)[int(random.integers(3))]
    lengths = 10.0 ** (spread * random.uniform(-1.0, 0.0, count))
    return levels.tolist(), [Fraction(float(length)) for length in lengths]


def phases(random: np.random.Generator, period: int) -> PhasesInPeriod:
    start, step = (Fraction(float(random.uniform(0.0, period))) for _ in range(2))
    return count_phases(start % period, step % period, period, STARTS)


@pytest.mark.parametrize("block", range(10))
def test_exposures_hold_the_light_of_exact_arithmetic(block: int) -> None:
    random = np.random.default_rng(block)
    worst = 0.0
    for _ in range(100):
        levels, lengths = pieces(random)
        exact, waveform = Exact(levels, lengths), Waveform(levels, lengths)
        exposure = Fraction(float(10.0 ** random.uniform(*DECADES))) * exact.count
        starts = phases(random, exact.count)
        duration = Duration.of(exposure, exact.count)
        light = waveform.light_in(starts, duration) / duration.in_units(exact.count)
        # Relative to a thousandth of a unit at least, as a start is known to 2e-16 units only.
        scale = max(exposure, Fraction(1, 1000))
        for whole, fraction, value in zip(starts.whole, starts.fraction, light, strict=True):
            start = int(whole) + Fraction(float(fraction))
            true = (exact.until(start + exposure) - exact.until(start)) / exposure
            off = abs(Fraction(float(value)) - true) * exposure / scale
            worst = max(worst, float(off))
    assert worst < 5e-13


def test_starts_at_edges_and_an_ulp_beside_lie_on_the_right_side() -> None:
    random = np.random.default_rng(3)
    for _ in range(60):
        levels, lengths = pieces(random)
        exact, waveform = Exact(levels, lengths), Waveform(levels, lengths)
        exposure = Fraction(1, 3)
        for edge in exact.edges[:: max(1, exact.count // 6)]:
            near = float(edge % exact.count)
            for place in (near, np.nextafter(near, 0.0), np.nextafter(near, np.inf)):
                whole = int(place) % exact.count
                starts = PhasesInPeriod(np.array([whole]), np.array([place - int(place)]))
                light = waveform.light_in(starts, Duration.of(exposure, exact.count))
                start = whole + Fraction(float(place - int(place)))
                true = exact.until(start + exposure) - exact.until(start)
                assert float(light[0]) == pytest.approx(float(true), abs=3e-13)


@pytest.mark.parametrize("block", range(4))
def test_edges_of_any_length_are_those_of_exact_arithmetic(block: int) -> None:
    random = np.random.default_rng(100 + block)
    for _ in range(30):
        levels, lengths = pieces(random)
        exact = Exact(levels, lengths)
        edge = Fraction(float(10.0 ** random.uniform(-4.0, 1.5)))
        exposure = Fraction(float(10.0 ** random.uniform(-3.0, 1.0)))
        waveform = EdgedWaveform(Waveform(levels, lengths), edge)
        start, step = (Fraction(float(random.uniform(0.0, exact.count))) for _ in range(2))

        def starts(
            shift: Fraction,
            start: Fraction = start,
            step: Fraction = step,
            period: int = exact.count,
        ) -> PhasesInPeriod:
            return count_phases((start + shift) % period, step % period, period, STARTS)

        light = waveform.light_in(starts, exposure) / float(exposure)
        for number, value in enumerate(light):
            at = start + number * step
            ends = (at + exposure, at), (at + exposure - edge, at - edge)
            swing = [exact.twice_until(last) - exact.twice_until(first) for last, first in ends]
            # The second integral of a period is no multiple of it: only whole ones are taken off.
            period_gain = exact.twice_until(exact.count - Fraction(1, 10**40))
            swing = [
                each + period_gain * (last // exact.count - first // exact.count)
                for each, (last, first) in zip(swing, ends, strict=True)
            ]
            true = exact.mean + (swing[0] - swing[1]) / (2 * edge * exposure)
            assert float(value) == pytest.approx(float(true), abs=2e-11)


def test_equal_pieces_are_chips_to_the_last_bit() -> None:
    random = np.random.default_rng(8)
    for _ in range(200):
        chips = random.integers(0, 2, int(random.integers(1, 60))).astype(np.uint8)
        period = len(chips)
        exposure = Fraction(float(10.0 ** random.uniform(-6.0, 6.0)))
        starts, duration = phases(random, period), Duration.of(exposure, period)
        as_chips = Waveform(chips).light_in(starts, duration)
        as_levels = Waveform(chips.astype(float), [Fraction(2, 7)] * period)
        np.testing.assert_array_equal(as_levels.light_in(starts, duration), as_chips)
