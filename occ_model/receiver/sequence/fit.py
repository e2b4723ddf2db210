"""Fit what the detector does not know: the phase and the brightness of the chips.

The light of a row is b(x) + a(x) p, with p the lit fraction of its exposure and x its place in the
picture; a and b vary slowly because of the lens and an uneven panel. These and the timing are
improved from detected chips (decision-directed), and then the chips are detected again.

An error of 1 % in the readout time shifts the ends of 96 chips by half a chip, and the ends of a
picture by several. Therefore the timing is fitted in the middle first, then in a part twice as
large, and so on up to the whole picture.

Functions that return a ``Reading`` yield the searches they need and are sent the chips found.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.products import dot, row_products
from occ_model.receiver.sequence.exposures import RowTiming, gather, taps
from occ_model.receiver.sequence.requests import Reading, Request, is_searched_completely
from occ_model.receiver.sequence.search import Chips
from occ_model.receiver.sequence.trellis import Word
from occ_model.receiver.signal import unexplained_fraction

_PHASES = 8  # number of phases tried, evenly spaced over one chip
TRIED_CHIPS = 96  # chips in the middle of the picture with which the phases are tried

_MAX_LAG = 3  # largest lag in rows; to a lag of 1 and more, independent noise contributes nothing
_MIN_NOISE = 1e-8  # minimum variance in squared fractions of full light: no model is more exact
_SINGULAR = 1e-10  # fraction of the largest singular value below which others are rounding errors
_MAX_STEP = 0.1  # most that an improvement moves the middle, and the ends against it, in chips


@dataclass(frozen=True, eq=False, slots=True)
class Brightness:
    """The light of rows with a dark lamp (b), and what a lit lamp adds (a), shape (rows,)."""

    dark: FloatArray
    swing: FloatArray

    def lit_fraction(self, light: FloatArray) -> FloatArray:
        """Return the light of each row as a fraction of full light."""
        return (light - self.dark) / self.swing


@dataclass(frozen=True, eq=False, slots=True)
class SequenceFit:
    """Chips, with the timing and the brightness with which they were detected."""

    chips: Chips
    timing: RowTiming
    brightness: Brightness
    model: FloatArray  # Shape (rows,): the lit fraction of each row according to the chips
    # Shape (rows,): the fraction of full light of each row minus that of the model
    residual: FloatArray

    @property
    def noise(self) -> float:
        """Variance of the rows about the model, in squared fractions of full light."""
        degrees_of_freedom = max(1, len(self.residual) - len(self.chips.values))
        return max(dot(self.residual, self.residual) / degrees_of_freedom, _MIN_NOISE)

    def noise_of_sums(self) -> float:
        """Return the variance per row of the residual's sum over an exposure.

        It exceeds the noise if neighbouring residuals are correlated and do not average out.
        """
        reach = min(round(self.timing.exposure / self.timing.step), len(self.residual) // 4)
        correlations = _autocorrelation(self.residual, reach)
        return self.noise * max(1.0, 1.0 + 2.0 * float(correlations[1:].sum()))

    def ratios(self) -> FloatArray:
        """Return the log-likelihood ratio of each chip to its opposite, shape (chips,)."""
        return np.asarray(self.chips.margins / (2.0 * self.noise_of_sums()))

    def unexplained(self) -> float:
        """Return the fraction of the variance that is neither that of the model nor noise."""
        return unexplained_fraction(self.model + self.residual, self.residual)


def lit_fractions(chips: Chips, timing: RowTiming, rows: int) -> tuple[FloatArray, FloatArray]:
    """Return the lit fraction of each row's exposure, and its derivative by the phase."""
    last, fractions = taps(timing, timing.starts(rows))
    index = last - np.arange(len(fractions))[:, None] - chips.first
    lit = chips.values.take(index, mode="clip").astype(np.float64)
    # The exposure gains the chip in which it ends and loses the one in which it starts.
    first = np.floor(timing.starts(rows)).astype(np.int64) - chips.first
    lost = chips.values.take(first, mode="clip")
    return np.einsum("ij,ij->j", fractions, lit), (lit[0] - lost) / timing.exposure


def guess_brightness(
    light: FloatArray, expected: FloatArray, timing: RowTiming, per_chip: int
) -> Brightness:
    """Estimate the brightness from the mean of the rows' light and the covariance of neighbours.

    ``expected``: the lit fractions of exposures of random data in the order of time, with
    ``per_chip`` values per chip.
    """
    centred = light - light.mean()
    lags = np.arange(1, _MAX_LAG + 1)
    row_covariances = np.array([dot(centred[lag:], centred[:-lag]) for lag in lags]) / len(light)
    centred_expected = expected - expected.mean()
    shifts = np.rint(lags * timing.step * per_chip).astype(np.int64)
    expected_covariances = np.array(
        [dot(np.roll(centred_expected, shift), centred_expected) for shift in shifts]
    ) / len(centred_expected)
    ratio = max(float(row_covariances.sum()), 1e-12) / max(float(expected_covariances.sum()), 1e-12)
    scale = float(np.sqrt(ratio))
    dark = float(light.mean()) - scale * float(expected.mean())
    return Brightness(np.full(len(light), dark), np.full(len(light), scale))


def find_phase(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...]
) -> Reading[RowTiming]:
    """Find the phase for which the chips in the middle of the picture fit best."""
    count = min(len(light), round((TRIED_CHIPS + timing.exposure) / timing.step))
    first = (len(light) - count) // 2
    lit_fraction = brightness.lit_fraction(light)[first : first + count]
    timings = [
        replace(timing, phase=timing.step * first + index / _PHASES) for index in range(_PHASES)
    ]
    statistics = [gather(lit_fraction, one) for one in timings]
    if is_searched_completely(words, timing.memory):
        distances = yield Request(words, timing.memory, statistics, only_distances=True)
    else:
        chips = yield Request(words, timing.memory, statistics)
        models = [lit_fractions(c, t, count)[0] for c, t in zip(chips, timings, strict=True)]
        distances = np.array([float(np.sum((lit_fraction - model) ** 2)) for model in models])
    best = timings[int(np.argmin(distances))]
    return replace(best, phase=best.phase - timing.step * first)


def detect(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...]
) -> Reading[SequenceFit]:
    """Detect the chips; ``light``: proportional to the light of each row, up to a constant."""
    lit_fraction = brightness.lit_fraction(light)
    (chips,) = yield Request(words, timing.memory, [gather(lit_fraction, timing)])
    model, _ = lit_fractions(chips, timing, len(lit_fraction))
    return SequenceFit(chips, timing, brightness, model, lit_fraction - model)


def improve(light: FloatArray, fit: SequenceFit) -> tuple[RowTiming, Brightness]:
    """Improve the timing and the brightness by least squares for the detected chips."""
    count = len(light)
    model, slope = lit_fractions(fit.chips, fit.timing, count)
    # The light is linear in a and b, which are parabolas over the picture, and nearly in the
    # timing.
    powers = _powers(count)
    terms = np.concatenate([powers, powers * model, powers[:2] * (slope * fit.brightness.swing)])
    products = row_products(terms, np.concatenate([terms, light[None]]))
    coefficients = np.linalg.lstsq(products[:, :-1], products[:, -1], rcond=_SINGULAR)[0]
    dark, swing = coefficients[:3] @ powers, coefficients[3:6] @ powers
    if not (swing > 0.0).all():
        return fit.timing, fit.brightness
    shift, drift = np.clip(coefficients[6:], -_MAX_STEP, _MAX_STEP).tolist()
    # The phase of the row at x changes by shift + drift x.
    step = fit.timing.step + 2.0 * drift / max(count - 1, 1)
    timing = replace(fit.timing, phase=fit.timing.phase + shift - drift, step=step)
    return timing, Brightness(dark, swing)


@lru_cache(maxsize=4)
def _powers(rows: int) -> FloatArray:
    """Return 1, x and x^2 for x from -1 to 1 over the rows, shape (3, rows)."""
    x = np.linspace(-1.0, 1.0, rows)
    return np.stack([np.ones(rows), x, x * x])


def _autocorrelation(values: FloatArray, reach: int) -> FloatArray:
    """Return the autocorrelation of values up to a lag of ``reach``, shape (reach + 1,)."""
    centred = values - values.mean()
    energy = max(dot(centred, centred), _MIN_NOISE)
    products = [dot(centred[lag:], centred[: len(centred) - lag]) for lag in range(1, reach + 1)]
    return np.array([energy, *products]) / energy


_MAX_PART_ROUNDS = 8  # largest number of improvements of a part's timing
_CONVERGED_CHIPS = 0.01  # movement of a part's ends in chips below which the fit has converged


def follow_timing(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...]
) -> Reading[RowTiming]:
    """Improve a timing that fits the middle but whose step may be wrong by a few percent."""
    count = len(light)
    size = round((TRIED_CHIPS + timing.exposure) / timing.step)
    while True:
        size = min(size, count)
        timing = yield from _follow_in_part(light, timing, brightness, words, size)
        if size == count:
            return timing
        size *= 2


def _follow_in_part(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...], size: int
) -> Reading[RowTiming]:
    first = (len(light) - size) // 2
    part = slice(first, first + size)
    part_light = light[part]
    part_brightness = Brightness(brightness.dark[part], brightness.swing[part])
    part_timing = replace(timing, phase=timing.phase + timing.step * first)
    for _ in range(_MAX_PART_ROUNDS):
        previous = part_timing
        fit = yield from detect(part_light, part_timing, part_brightness, words)
        part_timing, _brightness = improve(part_light, fit)
        if abs(part_timing.step - previous.step) * size < _CONVERGED_CHIPS:
            break
    return replace(part_timing, phase=part_timing.phase - part_timing.step * first)
