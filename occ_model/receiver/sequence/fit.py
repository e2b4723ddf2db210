"""Fit what the detector does not know: the phase of the chips, and how bright they are.

The light of a row is b(x) + a(x) p, with p the lit share of its exposure and x its place in the
picture; a and b vary slowly, as a lens and an uneven panel make them. They and the timing are
improved from chips that were detected (decision-directed), then the chips are detected anew.
"""

from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.receiver.sequence.exposures import Timing, gather, taps
from occ_model.receiver.sequence.max_log import Chips, best_chips, least_distances
from occ_model.receiver.sequence.trellis import Trellis

_PHASES = 8
"""Phases of the chips that are tried, evenly over one chip."""

_TRIED_CHIPS = 96
"""Chips in the middle of the picture that the phases are tried on."""

_LAGS = 3
"""Rows apart whose products give the contrast without the noise, which no two rows share."""

_MOST_STEP = 0.1
"""Largest change of the phase in one improvement, in chips."""


@dataclass(frozen=True, eq=False, slots=True)
class Brightness:
    """The light of rows without and with the lamp lit, shape (rows,) each: b and a."""

    dark: FloatArray
    swing: FloatArray

    def lit_share(self, light: FloatArray) -> FloatArray:
        """Return the share of full light of each row."""
        return (light - self.dark) / self.swing


@dataclass(frozen=True, eq=False, slots=True)
class Fit:
    """Chips, with the timing and the brightness that they were detected with.

    Parameters
    ----------
    chips, timing, brightness
        They.
    model : ndarray of float64, shape (rows,)
        The lit share of each row that the chips have.
    noise
        Standard deviation of the rows about the model, in shares of full light.
    """

    chips: Chips
    timing: Timing
    brightness: Brightness
    model: FloatArray
    noise: float


@dataclass(frozen=True, eq=False, slots=True)
class Rows:
    """Rows as the detector sees them.

    Parameters
    ----------
    light : ndarray of float64, shape (rows,)
        Proportional to the light of each, up to a constant.
    weights : ndarray of float64, shape (rows,)
        What each counts, 0 or 1.
    expected : ndarray of float64, shape (exposures,)
        The lit shares of exposures of random data in the order of time, for a first guess.
    """

    light: FloatArray
    weights: FloatArray
    expected: FloatArray


def lit_shares(chips: Chips, timing: Timing, rows: int) -> tuple[FloatArray, FloatArray]:
    """Return the lit share of each row's exposure, and its slope over the phase, shape (rows,)."""
    starts = timing.starts(rows)
    last, shares = taps(timing, starts)
    place = last[:, None] - np.arange(shares.shape[1]) - chips.first
    lit = chips.values[np.clip(place, 0, len(chips.values) - 1)].astype(np.float64)
    model = np.einsum("ij,ij->i", shares, lit)
    # The exposure gains the chip that it ends in and loses the one that it starts in.
    first = np.clip(np.floor(starts).astype(np.int64) - chips.first, 0, len(chips.values) - 1)
    return model, (lit[:, 0] - chips.values[first]) / timing.exposure


def first_guess(rows: Rows, timing: Timing, per_chip: int) -> Brightness:
    """Guess the brightness from the mean of the rows and the covariance of neighbours."""
    light, expected = rows.light, rows.expected
    seen = rows.weights > 0.0
    about = np.where(seen, light - light[seen].mean(), 0.0)
    lags = np.arange(1, _LAGS + 1)
    own = np.array([about[lag:] @ about[:-lag] for lag in lags]) / len(light)
    swing = expected - expected.mean()
    shifts = np.rint(lags * timing.step * per_chip).astype(np.int64)
    model = np.array([np.roll(swing, shift) @ swing for shift in shifts]) / len(swing)
    ratio = max(float(own.sum()), 1e-12) / max(float(model.sum()), 1e-12)
    scale = float(np.sqrt(ratio))
    dark = float(light[seen].mean()) - scale * float(expected.mean())
    return Brightness(np.full(len(light), dark), np.full(len(light), scale))


def find_phase(rows: Rows, timing: Timing, brightness: Brightness, trellis: Trellis) -> Timing:
    """Find the phase at which the chips in the middle of the picture fit best."""
    count = min(len(rows.light), round((_TRIED_CHIPS + timing.exposure) / timing.step))
    first = (len(rows.light) - count) // 2
    part = slice(first, first + count)
    light = brightness.lit_share(rows.light)[part]
    tried = [
        replace(timing, phase=timing.step * first + place / _PHASES) for place in range(_PHASES)
    ]
    distances = least_distances(trellis, [gather(light, rows.weights[part], one) for one in tried])
    best = tried[int(np.argmin(distances))]
    return replace(best, phase=best.phase - timing.step * first)


def detect(rows: Rows, timing: Timing, brightness: Brightness, trellis: Trellis) -> Fit:
    """Detect the chips at a timing and a brightness."""
    share = brightness.lit_share(rows.light)
    chips = best_chips(trellis, gather(share, rows.weights, timing))
    model, _ = lit_shares(chips, timing, len(share))
    residual = (share - model) * rows.weights
    free = max(1.0, float(rows.weights.sum()) - len(chips.values))
    return Fit(chips, timing, brightness, model, float(np.sqrt(residual @ residual / free)))


def improve(rows: Rows, fit: Fit) -> tuple[Timing, Brightness]:
    """Improve the timing and the brightness by least squares, the chips being as detected."""
    count = len(rows.light)
    place = np.linspace(-1.0, 1.0, count)
    model, slope = lit_shares(fit.chips, fit.timing, count)
    swing = fit.brightness.swing
    # The light is linear in a and b, each a parabola over the picture, and nearly in the timing.
    powers = place[:, None] ** np.arange(3)
    columns = np.concatenate(
        [powers, powers * model[:, None], (slope * swing)[:, None] * powers[:, :2]], axis=1
    )
    weighted = columns * rows.weights[:, None]
    normal = weighted.T @ columns
    normal[np.diag_indices(len(normal))] *= 1.0 + 1e-9
    found = np.linalg.lstsq(normal, weighted.T @ rows.light, rcond=None)[0]
    dark, swing = powers @ found[:3], powers @ found[3:6]
    if not (swing > 0.0).all():
        return fit.timing, fit.brightness
    shift, drift = np.clip(found[6:], -_MOST_STEP, _MOST_STEP).tolist()
    # The phase of the row at x is shift + drift x.
    step = fit.timing.step + 2.0 * drift / max(count - 1, 1)
    timing = replace(fit.timing, phase=fit.timing.phase + shift - drift, step=step)
    return timing, Brightness(dark, swing)
