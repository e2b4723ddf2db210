"""Results of matching a photo: its stripes, the scene that explains them, a comparison."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene

PLAIN_STRIPES = (
    "These look like plain stripes of one lamp: if it is one, say that it sends a square wave."
)
"""What to do about a refused pulse that repeats."""


@dataclass(frozen=True, eq=False, slots=True)
class Stripes:
    """The stripes in a photo.

    Parameters
    ----------
    region
        The rectangle of the photo that they fill.
    profile : ndarray of float64, shape (columns of the region,)
        Mean of each column of the region, in grey levels.
    low, high : ndarray of float64, shape as ``profile``
        The slowly varying dark and bright level of the stripes.
    period
        Columns after which the stripes repeat; None where they do not repeat in the region.
    period_uncertainty
        Its standard deviation in columns.
    saturated
        Fraction of the region's pixels that are white.
    """

    region: Region
    profile: FloatArray
    low: FloatArray
    high: FloatArray
    period: float | None
    period_uncertainty: float | None
    saturated: float

    @property
    def flattened(self) -> FloatArray:
        """The profile without the uneven light, from 0 (dark) to 1 (bright), shape (columns,)."""
        return (self.profile - self.low) / (self.high - self.low)


@dataclass(frozen=True, slots=True)
class Alternative:
    """Another explanation of a photo's stripes than the one that a match gives.

    Parameters
    ----------
    sent
        What it says is sent, in words.
    pattern
        The chips sent, from the start of a period; empty where it says that there is no code.
    correlation
        Correlation of its profile with the photo's, both without the uneven light.
    evidence
        Natural logarithm of its likelihood less that of the match, both with a penalty for what
        was chosen freely; below 0 where it is the less likely one.
    readout_time, switching_frequency, exposure_time
        In SI units; None where it has none.
    """

    sent: str
    pattern: str
    correlation: float
    evidence: float
    readout_time: float | None = None
    switching_frequency: float | None = None
    exposure_time: float | None = None


@dataclass(frozen=True, eq=False, slots=True)
class ChipReading:
    """The chips in a photo's stripes, read without knowing what is sent or whether it repeats.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        The chips in view, from the first edge between two stripes to the last one.
    columns_per_chip
        Length of a chip in columns.
    confidence
        Probability, from 0 to 1, that all of the chips are right; calibrated on simulated messages.
    start
        Column of the photo at which the first of them starts.
    region
        The rectangle of the photo that was read.
    """

    chips: ByteArray
    columns_per_chip: float
    confidence: float
    start: float
    region: Region

    @property
    def text(self) -> str:
        """The chips as a text of zeros and ones."""
        return "".join(map(str, self.chips.tolist()))


_BY_EXPOSURE = ("exposure_time", "start_time", "gamma")
"""Estimates that another exposure changes: a column's start is half of it before its middle."""

_SHOWN_TOLERANCE = 5e-7
"""Relative difference of two values that are the same in the six digits that are shown."""

_ERROR_TOLERANCE = 1e-3
"""Fraction of an estimate's deviation by which two values may differ and yet be the same."""

_ONLY_EXPOSURE = "Only the exposure time, and with it the start time, is doubtful."


@dataclass(frozen=True, eq=False, slots=True)
class Match:
    """The scene that explains a photo's stripes.

    Parameters
    ----------
    scene
        The scene given, with the parameters found in the photo.
    stripes
        The stripes that were matched, with the levels of the fit.
    readout_time, switching_frequency, exposure_time, start_time, gamma
        The scene's, in SI units; ``start_time`` is that of the photo's first column.
    uncertainties
        Standard deviations of those that were estimated, in SI units, by name.
    pattern
        The chips sent, from the start of a period.
    pattern_was_read
        Whether it was read from the photo.
    profile : ndarray of float64, shape (columns of the region,)
        The aligned profile: that of the fitted scene in the photo's light, in grey levels.
    correlation
        Correlation of that profile with the photo's, both without the uneven light.
    other_exposures
        Other exposure times in seconds that explain the stripes equally well, the shortest first.
    reasons
        Why the match is doubtful, each a sentence; none where it is sure.
    alternatives
        Other explanations of the stripes, the most likely first.
    exposure_reasons
        Why the exposure time, and what follows from it, is doubtful, each a sentence: the chips and
        the readout time, or the frequency, do not rest on it.
    """

    scene: Scene
    stripes: Stripes
    readout_time: float
    switching_frequency: float
    exposure_time: float
    start_time: float
    gamma: float
    uncertainties: Mapping[str, float]
    pattern: str
    pattern_was_read: bool
    profile: FloatArray
    correlation: float
    other_exposures: tuple[float, ...] = ()
    reasons: tuple[str, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    exposure_reasons: tuple[str, ...] = ()

    @property
    def verdict(self) -> str:
        """``"sure"``, or ``"doubtful"`` where there is a reason to doubt the match."""
        return "doubtful" if self.reasons else "sure"

    @property
    def exposure_verdict(self) -> str:
        """``"sure"``, or ``"doubtful"`` where the match or its exposure time is."""
        return "doubtful" if self.reasons or self.exposure_reasons else "sure"

    @property
    def only_exposure_is_doubtful(self) -> bool:
        """Whether all but the exposure time is sure."""
        return bool(self.exposure_reasons) and not self.reasons

    @property
    def doubtful_alone(self) -> tuple[str, ...]:
        """Names of the estimates that are doubtful while the match is sure: those by exposure."""
        return _BY_EXPOSURE if self.only_exposure_is_doubtful else ()

    @property
    def all_reasons(self) -> tuple[str, ...]:
        """The reasons to doubt the match, and those to doubt its exposure time, said so."""
        if not self.only_exposure_is_doubtful:
            return (*self.reasons, *self.exposure_reasons)
        first, *more = self.exposure_reasons
        return (f"{_ONLY_EXPOSURE} {first}", *more)

    def is_applied_to(self, scene: Scene) -> bool:
        """Whether a scene is the matched one, as far as the match tells.

        A match that starts from the matched scene ends there again, but for rounding.
        """
        if scene == self.scene:
            return True
        return all(
            self._is_same(name, scene.value(name), value)
            for table in self.scene.tables().values()
            for name, value in table.items()
        )

    def _is_same(self, name: str, there: object, here: object) -> bool:
        if not isinstance(there, float) or not isinstance(here, float):
            return there == here
        step = _ERROR_TOLERANCE * self.uncertainties.get(name, 0.0)
        return math.isclose(there, here, rel_tol=_SHOWN_TOLERANCE, abs_tol=step)

    @property
    def columns_per_chip(self) -> float:
        """Length of a chip in columns."""
        return 1.0 / (self.switching_frequency * self.readout_time)

    @property
    def periods_in_view(self) -> float:
        """How often the pattern is sent while the region's columns are read out."""
        return len(self.profile) / (self.columns_per_chip * len(self.pattern))

    @property
    def exposure_in_chips(self) -> float:
        """The exposure time in chips."""
        return self.exposure_time * self.switching_frequency

    @property
    def duty(self) -> float:
        """Fraction of the pattern in which the LED is on, from 0 to 1."""
        return self.pattern.count("1") / len(self.pattern)

    @property
    def region(self) -> Region:
        """The rectangle of the photo that was matched."""
        return self.stripes.region

    @property
    def residual(self) -> FloatArray:
        """The photo's profile less the aligned one, in grey levels, shape (columns,)."""
        return self.stripes.profile - self.profile

    @property
    def rmse(self) -> float:
        """Root mean square of the residual, in grey levels."""
        return float(np.sqrt(np.mean(self.residual**2)))


_USUAL_FRACTION = 0.95
"""Fraction of columns whose residual an axis shows whole: a single edge is not to set it."""


@dataclass(frozen=True, eq=False, slots=True)
class Comparison:
    """A photo's profile beside a simulated one, column by column of the simulation.

    Parameters
    ----------
    first_column
        The first column of the simulation that the photo lies on.
    photo : ndarray of float64, shape (columns,)
        The photo's profile without its uneven light, in the simulation's grey levels.
    simulated : ndarray of float64, shape (columns,)
        The simulation's profile in these columns.
    correlation
        Correlation of the two; 0 where one of them is flat.
    height : ndarray of float64, shape (columns,), or None
        Height of the photo's stripes over its root mean square, by which columns count; None where
        all count alike.
    """

    first_column: int
    photo: FloatArray
    simulated: FloatArray
    correlation: float
    height: FloatArray | None = None

    @property
    def residual(self) -> FloatArray:
        """The photo's profile less the simulated one, in grey levels, shape (columns,).

        Where the photo's stripes are faint it is as faint.
        """
        residual = self.photo - self.simulated
        return residual if self.height is None else residual * self.height

    @property
    def largest_residual(self) -> float:
        """The residual that is farthest from 0, without its sign, in grey levels."""
        return float(np.abs(self.residual).max())

    @property
    def usual_residual(self) -> float:
        """The grey levels that 95 of 100 columns stay within: what an axis is to show."""
        return float(np.quantile(np.abs(self.residual), _USUAL_FRACTION))

    @property
    def rmse(self) -> float:
        """Root mean square of the residual, in grey levels."""
        return float(np.sqrt(np.mean(self.residual**2)))
