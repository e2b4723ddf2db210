"""Fit what the detector does not know: the phase of the chips, and their brightness.

The light of a row is b(x) + a(x) p, with p the lit fraction of its exposure and x its place in the
picture; a and b vary slowly because of the lens and an uneven panel. These and the timing are
improved from detected chips (decision-directed), and then the chips are detected again.

An error of 1 % in the readout time amounts to half a chip at the ends of 96 chips, and to several
chips over a picture. The chips detected in the middle give the timing there, which holds for a part
twice as large, and so on up to the whole picture.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.receiver.sequence.code_words import MOST_STATES
from occ_model.receiver.sequence.exposures import ChipStatistics, RowTiming, gather, taps
from occ_model.receiver.sequence.search import Chips, find_best_chips, least_distances, search_beam
from occ_model.receiver.sequence.trellis import Word, count_most_states, make_trellis
from occ_model.receiver.signal import unexplained_fraction

_PHASES = 8  # number of phases tried, evenly spaced over one chip
TRIED_CHIPS = 96  # chips in the middle of the picture with which the phases are tried

_LAG_ROWS = 3  # distance in rows at which products show the contrast without the independent noise
_MIN_NOISE = 1e-8  # minimum variance in fractions of full light, since no model is more exact
_SINGULAR = 1e-10  # fraction of the largest singular value below which others are rounding errors
_MAX_STEP = 0.1  # maximum change of the phase in one improvement, in chips


@dataclass(frozen=True, eq=False, slots=True)
class Brightness:
    """The light of rows with a dark lamp (b), and the swing by a lit one (a), shape (rows,)."""

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
        free = max(1, len(self.residual) - len(self.chips.values))
        return max(float(self.residual @ self.residual) / free, _MIN_NOISE)

    def noise_of_sums(self) -> float:
        """Return the variance per row of the residual's sum over an exposure.

        It exceeds the noise if neighbouring residuals are correlated and do not average out.
        """
        reach = min(round(self.timing.exposure / self.timing.step), len(self.residual) // 4)
        own = _autocorrelation(self.residual, reach)
        return self.noise * max(1.0, 1.0 + 2.0 * float(own[1:].sum()))

    def ratios(self) -> FloatArray:
        """Return the log-likelihood ratio of each chip to its opposite, shape (chips,)."""
        return np.asarray(self.chips.margins / (2.0 * self.noise_of_sums()))

    def unexplained(self) -> float:
        """Return the fraction of the variance that is neither that of the model nor noise."""
        return unexplained_fraction(self.model + self.residual, self.residual)


def lit_fractions(chips: Chips, timing: RowTiming, rows: int) -> tuple[FloatArray, FloatArray]:
    """Return the lit fraction of each row's exposure, and its derivative with the phase."""
    starts = timing.starts(rows)
    last, fractions = taps(timing, starts)
    place = last[:, None] - np.arange(fractions.shape[1]) - chips.first
    lit = chips.values[np.clip(place, 0, len(chips.values) - 1)].astype(np.float64)
    model = np.einsum("ij,ij->i", fractions, lit)
    # The exposure gains the chip in which it ends and loses the one in which it starts.
    first = np.clip(np.floor(starts).astype(np.int64) - chips.first, 0, len(chips.values) - 1)
    return model, (lit[:, 0] - chips.values[first]) / timing.exposure


def guess_brightness(
    light: FloatArray, expected: FloatArray, timing: RowTiming, per_chip: int
) -> Brightness:
    """Estimate the brightness from the mean of the rows' light and the covariance of neighbours.

    ``expected``: the lit fractions of exposures of random data in the order of time, with
    ``per_chip`` values per chip.
    """
    about = light - light.mean()
    lags = np.arange(1, _LAG_ROWS + 1)
    own = np.array([about[lag:] @ about[:-lag] for lag in lags]) / len(light)
    swing = expected - expected.mean()
    shifts = np.rint(lags * timing.step * per_chip).astype(np.int64)
    model = np.array([np.roll(swing, shift) @ swing for shift in shifts]) / len(swing)
    ratio = max(float(own.sum()), 1e-12) / max(float(model.sum()), 1e-12)
    scale = float(np.sqrt(ratio))
    dark = float(light.mean()) - scale * float(expected.mean())
    return Brightness(np.full(len(light), dark), np.full(len(light), scale))


def find_phase(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...]
) -> RowTiming:
    """Find the phase for which the chips in the middle of the picture fit best."""
    count = min(len(light), round((TRIED_CHIPS + timing.exposure) / timing.step))
    first = (len(light) - count) // 2
    fraction = brightness.lit_fraction(light)[first : first + count]
    tried = [
        replace(timing, phase=timing.step * first + place / _PHASES) for place in range(_PHASES)
    ]
    seen = [gather(fraction, one) for one in tried]
    if count_most_states(words, timing.memory) <= MOST_STATES:
        distances = least_distances(make_trellis(words, timing.memory), seen)
    else:
        chips = [_find_most_likely(words, timing, one) for one in seen]
        models = [lit_fractions(c, t, count)[0] for c, t in zip(chips, tried, strict=True)]
        distances = np.array([float(np.sum((fraction - model) ** 2)) for model in models])
    best = tried[int(np.argmin(distances))]
    return replace(best, phase=best.phase - timing.step * first)


def detect(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...]
) -> SequenceFit:
    """Detect the chips; ``light``: proportional to the light of each row, up to a constant."""
    fraction = brightness.lit_fraction(light)
    chips = _find_most_likely(words, timing, gather(fraction, timing))
    model, _ = lit_fractions(chips, timing, len(fraction))
    return SequenceFit(chips, timing, brightness, model, fraction - model)


def _find_most_likely(
    words: tuple[Word, ...], timing: RowTiming, statistics: ChipStatistics
) -> Chips:
    if count_most_states(words, timing.memory) <= MOST_STATES:
        return find_best_chips(make_trellis(words, timing.memory), statistics)
    return search_beam(words, timing.memory, statistics)


def improve(light: FloatArray, fit: SequenceFit) -> tuple[RowTiming, Brightness]:
    """Improve the timing and the brightness by least squares for the detected chips."""
    count = len(light)
    model, slope = lit_fractions(fit.chips, fit.timing, count)
    # The light is linear in a and b, which are parabolas over the picture, and nearly in the
    # timing.
    powers = _powers(count)
    terms = np.concatenate([powers, powers * model, powers[:2] * (slope * fit.brightness.swing)])
    found = np.linalg.lstsq(terms @ terms.T, terms @ light, rcond=_SINGULAR)[0]
    dark, swing = found[:3] @ powers, found[3:6] @ powers
    if not (swing > 0.0).all():
        return fit.timing, fit.brightness
    shift, drift = np.clip(found[6:], -_MAX_STEP, _MAX_STEP).tolist()
    # The phase of the row at x changes by shift + drift x.
    step = fit.timing.step + 2.0 * drift / max(count - 1, 1)
    timing = replace(fit.timing, phase=fit.timing.phase + shift - drift, step=step)
    return timing, Brightness(dark, swing)


@lru_cache(maxsize=4)
def _powers(rows: int) -> FloatArray:
    """Return 1, x and x squared for x from -1 to 1 over the rows, shape (3, rows)."""
    place = np.linspace(-1.0, 1.0, rows)
    return np.stack([np.ones(rows), place, place * place])


def _autocorrelation(values: FloatArray, reach: int) -> FloatArray:
    """Return the autocorrelation of values up to a lag of ``reach``, shape (reach + 1,)."""
    about = values - values.mean()
    energy = max(float(about @ about), _MIN_NOISE)
    ahead = [float(about[lag:] @ about[: len(about) - lag]) for lag in range(1, reach + 1)]
    return np.array([energy, *ahead]) / energy


_MAX_TURNS = 8  # rounds for a part's timing, each of which moves its ends by at most 0.1 chips
_CONVERGED_CHIPS = 0.01  # movement of a part's ends in chips below which the fit has converged


def follow_timing(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...]
) -> RowTiming:
    """Improve a timing that fits the middle, and whose step may be wrong by some percent."""
    count = len(light)
    size = round((TRIED_CHIPS + timing.exposure) / timing.step)
    while True:
        size = min(size, count)
        timing = _follow_in_part(light, timing, brightness, words, size)
        if size == count:
            return timing
        size *= 2


def _follow_in_part(
    light: FloatArray, timing: RowTiming, brightness: Brightness, words: tuple[Word, ...], size: int
) -> RowTiming:
    first = (len(light) - size) // 2
    part = slice(first, first + size)
    seen = light[part]
    bright = Brightness(brightness.dark[part], brightness.swing[part])
    here = replace(timing, phase=timing.phase + timing.step * first)
    for _ in range(_MAX_TURNS):
        before = here
        here, _bright = improve(seen, detect(seen, here, bright, words))
        if abs(here.step - before.step) * size < _CONVERGED_CHIPS:
            break
    return replace(here, phase=here.phase - here.step * first)
