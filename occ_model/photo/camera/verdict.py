"""Whether bars in pictures are those of lamps on the mains: refused, doubtful or sure."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.errors import MatchError
from occ_model.photo.camera.bars_fit import MOST_BARS, BarsFit, fit_bars
from occ_model.photo.camera.quotient import LineValues, quotient_of_lines
from occ_model.photo.reading.load import Photo
from occ_model.scene.units import PERCENT

# Limits set on simulated pairs of the seeds below 100 and half of the real pictures. Evidence is a
# natural logarithm of a ratio of likelihoods.
_LEAST_SEEN = 0.15  # fraction of the tiles' lines that have usable pixels
LEAST_FOR_ANY = 60.0  # evidence for bars, for a doubtful answer
_LEAST_FOR_SURE = 300.0  # evidence for bars, for a sure answer
_LEAST_GAP = 40.0  # evidence for a number of bars over all others
_FEWEST_SURE_BARS = 1.9  # fewer do not show that they repeat
_LARGEST_ERROR = 0.015  # relative error of a sure answer
_SAME = 0.03  # relative difference up to which two numbers of bars count as equal
_BENT, _PERHAPS_BENT = 15.0, 6.0  # evidence for a lens correction: refused, doubtful
_MOST_MODULATION = 0.5
# Relative deviations of answers that are doubtful for these reasons, from the same simulated pairs.
_ERROR_OF_FEW, _ERROR_OF_CHANGING = 0.12, 0.08

# Slopes in radians, for a single picture, in which the room's own pattern does not cancel:
_MOST_TILT = 5e-4  # of bars of light; what people hang up is level only to about 1e-2
_SLANTED = 0.08  # which is more than lamps on different phases of the mains cause

_ANOTHER = "Take a second picture a moment later, and give both."
_ONE_PICTURE = (
    "One picture does not tell bars of light from what is painted or built, such as slats or the "
    f"boards of a door. {_ANOTHER}"
)


@dataclass(frozen=True, slots=True)
class _Tilt:
    """Slope of the bars over the lines in radians, and its standard deviation."""

    slope: float
    deviation: float

    @property
    def largest(self) -> float:
        """The largest slope that is credible."""
        return abs(self.slope) + 2.0 * self.deviation

    @property
    def is_level(self) -> bool:
        return self.largest < _MOST_TILT


def refuse_unseen(lines: LineValues) -> None:
    """Raise MatchError with the reason if too little of the pictures can be used for a fit."""
    if lines.seen < _LEAST_SEEN:
        raise MatchError(
            f"Only {PERCENT.format(lines.seen, 2)} of the picture can be used; the rest is too "
            "dark or too bright. Take it with another exposure."
        )


def refuse(photos: list[Photo], axes: list[str], lines: LineValues, fit: BarsFit) -> None:
    """Raise MatchError with the reason if the pictures show no bars that can be measured."""
    if fit.gap_to_none < LEAST_FOR_ANY:
        raise MatchError(*_why_none(photos, axes))
    if len(photos) == 1 and tilt_of(lines, fit).largest > _SLANTED:
        raise MatchError(
            "The picture's pattern is not along its lines, as bars of light are: it may be the "
            f"room's own. {_ANOTHER}"
        )
    if fit.bend_gap > _BENT and abs(fit.bend) > 0.0:
        raise MatchError(
            f"The bars are bent, by {PERCENT.format(abs(fit.bend), 1)} in the corners: the camera "
            "or a program has corrected the lens's distortion, which moved the lines. Switch the "
            "correction off, or take the RAW file."
        )


def _why_none(photos: list[Photo], axes: list[str]) -> list[str]:
    if len(photos) == 1:
        return [
            "The picture shows no bars. Take it at 1/1000 s, under lamps on the mains without "
            "daylight."
        ]
    reason = (
        "The two pictures do not differ by bars. Take them at 1/1000 s, one after the other, under "
        "lamps on the mains without daylight."
    )
    for axis in axes:
        counts = [bars for photo in photos if (bars := _count_alone(photo, axis)) is not None]
        if len(counts) < len(photos) or abs(counts[0] / counts[1] - 1.0) > _SAME:
            continue
        return [
            f"Each picture shows {counts[0]:.1f} bars, at the same place in both: bars that stand "
            "still between two pictures cannot be told from the room. Take the second picture at "
            "another moment, not in a film or burst."
        ]
    return [reason]


def _count_alone(photo: Photo, axis: str) -> float | None:
    """Return the number of bars in one picture by itself, None if they may be the room's."""
    lines = quotient_of_lines([photo], axis)
    fit = fit_bars(lines)
    is_strong = fit.gap_to_none > _LEAST_FOR_SURE
    return fit.bars if is_strong and tilt_of(lines, fit).is_level else None


def stated_deviation(fit: BarsFit) -> float:
    """Return the standard deviation of the number of bars, with what a doubt adds to it."""
    parts = [fit.deviation]
    if fit.bars < _FEWEST_SURE_BARS:
        parts.append(_ERROR_OF_FEW * fit.bars)
    if fit.scales.modulation > _MOST_MODULATION:
        parts.append(_ERROR_OF_CHANGING * fit.bars)
    if fit.gap < _LEAST_GAP:
        parts.append(0.5 * abs(fit.other - fit.bars))
    return math.hypot(*parts)


def doubts(fit: BarsFit, *, is_single: bool) -> list[str]:
    """Return sentences on why bars may be others, or their number wrong; none if it is sure."""
    reasons = []
    if fit.bars < _FEWEST_SURE_BARS:
        reasons.append(
            f"{fit.bars:.2f} bars are in the picture; at least {_FEWEST_SURE_BARS} are needed to "
            "see that they repeat."
        )
    if fit.bars > MOST_BARS - 1.0:
        reasons.append(f"{fit.bars:.1f} bars or more; at most {MOST_BARS:.0f} are searched for.")
    if fit.gap < _LEAST_GAP:
        reasons.append(f"{fit.other:.2f} bars explain the pictures nearly as well.")
    if fit.deviation > _LARGEST_ERROR * fit.bars:
        error = PERCENT.format(fit.deviation / fit.bars, 2)
        reasons.append(f"The error is {error}; at most {PERCENT.format(_LARGEST_ERROR)} is sure.")
    if fit.gap_to_none < _LEAST_FOR_SURE:
        reasons.append("The bars are weak beside what else differs.")
    if fit.scales.modulation > _MOST_MODULATION:
        reasons.append("The bars change much from one place of the picture to another.")
    if fit.bend_gap > _PERHAPS_BENT:
        reasons.append("The bars seem bent, as by a correction of the lens's distortion.")
    return [*reasons, _ONE_PICTURE] if is_single else reasons


def tilt_of(lines: LineValues, fit: BarsFit) -> _Tilt:
    """Return the slope of the bars by the phases of their first harmonic in the tiles."""
    count = fit.waves.shape[1]
    turn = np.exp(-2j * math.pi * fit.bars * (np.arange(count) + 0.5) / count)
    waves = (fit.waves * turn).sum(axis=1)
    middle = np.sum(waves)
    phases = np.angle(waves / middle) if middle else np.zeros(len(waves))
    # A cycle of the phase is one bar; lines over columns of shift from tile to tile are the slope.
    heights = phases / (2.0 * math.pi) * lines.lines / fit.bars
    across = lines.places * lines.columns
    strength = np.abs(waves) ** 2
    strength = strength / max(float(strength.sum()), 1e-12)
    across = across - float((strength * across).sum())
    spread = max(float((strength * across**2).sum()), 1e-9)
    slope = float((strength * across * heights).sum()) / spread
    left = heights - float((strength * heights).sum()) - slope * across
    scatter = float((strength * left**2).sum()) / max(len(waves) - 2, 1)
    return _Tilt(slope, math.sqrt(scatter / spread))
