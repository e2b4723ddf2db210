"""Fit what the detector does not know: the phase of the chips, and how bright they are.

The light of a row is b(x) + a(x) p, with p the lit fraction of its exposure and x its place in the
picture; a and b vary slowly, as a lens and an uneven panel make them. They and the timing are
improved from chips that were detected (decision-directed), then the chips are detected anew.

A readout time that is 1 % off is half a chip at the ends of 96 chips, and several chips over a
picture. What is detected in the middle gives the timing there, which holds for a part twice as
large; and so on to the whole picture.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.receiver.sequence.code_words import MOST_STATES
from occ_model.receiver.sequence.exposures import ChipStatistics, Timing, gather, taps
from occ_model.receiver.sequence.search import Chips, beam_chips, best_chips, least_distances
from occ_model.receiver.sequence.trellis import Word, most_states, trellis_of
from occ_model.receiver.signal import unexplained_fraction

_PHASES = 8  # phases of the chips that are tried, evenly over one chip
TRIED_CHIPS = 96  # chips in the middle of the picture that the phases are tried on

_LAG_ROWS = 3  # rows apart whose products have the contrast without the noise, which is independent
_MIN_NOISE = 1e-8  # minimum variance, in fractions of full light squared: no model is more exact
_SINGULAR = 1e-10  # fraction of the largest singular value below which one is rounding error
_MAX_STEP = 0.1  # largest change of the phase in one improvement, in chips


@dataclass(frozen=True, eq=False, slots=True)
class Brightness:
    """The light of rows without and with the lamp lit, shape (rows,) each: b and a."""

    dark: FloatArray
    swing: FloatArray

    def lit_fraction(self, light: FloatArray) -> FloatArray:
        """Return the fraction of full light of each row."""
        return (light - self.dark) / self.swing


@dataclass(frozen=True, eq=False, slots=True)
class Fit:
    """Chips, with the timing and the brightness that they were detected with."""

    chips: Chips
    timing: Timing
    brightness: Brightness
    model: FloatArray  # Shape (rows,): the lit fraction of each row that the chips have
    # Shape (rows,): the fraction of full light of each row less that of the model
    residual: FloatArray

    @property
    def noise(self) -> float:
        """Variance of the rows about the model, in fractions of full light squared."""
        free = max(1, len(self.residual) - len(self.chips.values))
        return max(float(self.residual @ self.residual) / free, _MIN_NOISE)

    def noise_of_sums(self) -> float:
        """Variance a row of the residual's sum over rows, up to an exposure apart.

        It exceeds the noise where neighbouring residuals are equal and do not average out.
        """
        reach = min(round(self.timing.exposure / self.timing.step), len(self.residual) // 4)
        own = _autocorrelation(self.residual, reach)
        return self.noise * max(1.0, 1.0 + 2.0 * float(own[1:].sum()))

    def ratios(self) -> FloatArray:
        """Log-likelihood ratio of each chip over its opposite, shape (chips,)."""
        return np.asarray(self.chips.margins / (2.0 * self.noise_of_sums()))

    def unexplained(self) -> float:
        """Fraction of the variance that is neither model nor noise."""
        return unexplained_fraction(self.model + self.residual, self.residual)


def lit_fractions(chips: Chips, timing: Timing, rows: int) -> tuple[FloatArray, FloatArray]:
    """Return the lit fraction of each row's exposure, and its derivative by the phase."""
    starts = timing.starts(rows)
    last, fractions = taps(timing, starts)
    place = last[:, None] - np.arange(fractions.shape[1]) - chips.first
    lit = chips.values[np.clip(place, 0, len(chips.values) - 1)].astype(np.float64)
    model = np.einsum("ij,ij->i", fractions, lit)
    # The exposure gains the chip that it ends in and loses the one that it starts in.
    first = np.clip(np.floor(starts).astype(np.int64) - chips.first, 0, len(chips.values) - 1)
    return model, (lit[:, 0] - chips.values[first]) / timing.exposure


def first_guess(
    light: FloatArray, expected: FloatArray, timing: Timing, per_chip: int
) -> Brightness:
    """Guess the brightness from the mean of the rows' light and the covariance of neighbours.

    ``expected``: the lit fractions of exposures of random data in the order of time, ``per_chip``
    of them a chip.
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
    light: FloatArray, timing: Timing, brightness: Brightness, words: tuple[Word, ...]
) -> Timing:
    """Find the phase at which the chips in the middle of the picture fit best."""
    count = min(len(light), round((TRIED_CHIPS + timing.exposure) / timing.step))
    first = (len(light) - count) // 2
    fraction = brightness.lit_fraction(light)[first : first + count]
    tried = [
        replace(timing, phase=timing.step * first + place / _PHASES) for place in range(_PHASES)
    ]
    seen = [gather(fraction, one) for one in tried]
    if most_states(words, timing.memory) <= MOST_STATES:
        distances = least_distances(trellis_of(words, timing.memory), seen)
    else:
        chips = [_likeliest(words, timing, one) for one in seen]
        models = [lit_fractions(c, t, count)[0] for c, t in zip(chips, tried, strict=True)]
        distances = np.array([float(np.sum((fraction - model) ** 2)) for model in models])
    best = tried[int(np.argmin(distances))]
    return replace(best, phase=best.phase - timing.step * first)


def detect(
    light: FloatArray, timing: Timing, brightness: Brightness, words: tuple[Word, ...]
) -> Fit:
    """Detect the chips; ``light``: proportional to that of each row, up to a constant."""
    fraction = brightness.lit_fraction(light)
    chips = _likeliest(words, timing, gather(fraction, timing))
    model, _ = lit_fractions(chips, timing, len(fraction))
    return Fit(chips, timing, brightness, model, fraction - model)


def _likeliest(words: tuple[Word, ...], timing: Timing, statistics: ChipStatistics) -> Chips:
    if most_states(words, timing.memory) <= MOST_STATES:
        return best_chips(trellis_of(words, timing.memory), statistics)
    return beam_chips(words, timing.memory, statistics)


def improve(light: FloatArray, fit: Fit) -> tuple[Timing, Brightness]:
    """Improve the timing and the brightness by least squares, the chips being as detected."""
    count = len(light)
    model, slope = lit_fractions(fit.chips, fit.timing, count)
    # The light is linear in a and b, each a parabola over the picture, and nearly in the timing.
    powers = _powers(count)
    terms = np.concatenate([powers, powers * model, powers[:2] * (slope * fit.brightness.swing)])
    found = np.linalg.lstsq(terms @ terms.T, terms @ light, rcond=_SINGULAR)[0]
    dark, swing = found[:3] @ powers, found[3:6] @ powers
    if not (swing > 0.0).all():
        return fit.timing, fit.brightness
    shift, drift = np.clip(found[6:], -_MAX_STEP, _MAX_STEP).tolist()
    # The phase of the row at x is shift + drift x.
    step = fit.timing.step + 2.0 * drift / max(count - 1, 1)
    timing = replace(fit.timing, phase=fit.timing.phase + shift - drift, step=step)
    return timing, Brightness(dark, swing)


@lru_cache(maxsize=4)
def _powers(rows: int) -> FloatArray:
    """Return 1, x and x squared, x going from -1 to 1 over the rows, shape (3, rows)."""
    place = np.linspace(-1.0, 1.0, rows)
    return np.stack([np.ones(rows), place, place * place])


def _autocorrelation(values: FloatArray, reach: int) -> FloatArray:
    """Return the correlation of values with those some places on, shape (reach + 1,)."""
    about = values - values.mean()
    energy = max(float(about @ about), _MIN_NOISE)
    ahead = [float(about[lag:] @ about[: len(about) - lag]) for lag in range(1, reach + 1)]
    return np.array([energy, *ahead]) / energy


_MAX_TURNS = 8  # iterations of a part's timing; each moves its ends by at most 0.1 chips
_CONVERGED_CHIPS = 0.01  # motion of a part's ends in chips below which the fit has converged


def follow_timing(
    light: FloatArray, timing: Timing, brightness: Brightness, words: tuple[Word, ...]
) -> Timing:
    """Improve a timing that fits the middle, and may be some percent off from row to row."""
    count = len(light)
    size = round((TRIED_CHIPS + timing.exposure) / timing.step)
    while True:
        size = min(size, count)
        timing = _in_part(light, timing, brightness, words, size)
        if size == count:
            return timing
        size *= 2


def _in_part(
    light: FloatArray, timing: Timing, brightness: Brightness, words: tuple[Word, ...], size: int
) -> Timing:
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
