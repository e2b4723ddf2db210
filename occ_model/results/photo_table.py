"""Table of several matched photos, and their combined estimates."""

from dataclasses import dataclass, field
from pathlib import Path

from occ_model.results.match import Match
from occ_model.scene.scene import Scene

SURE, DOUBTFUL, REFUSED, UNREADABLE = "sure", "doubtful", "refused", "unreadable"
"""Verdicts on a photo: those of a match, no match, and a file that cannot be read."""

VERDICTS = (SURE, DOUBTFUL, REFUSED, UNREADABLE)


def known_beside(estimate: str) -> str:
    """Return the parameter that is taken as known while the other one is estimated."""
    both = ("readout_time", "switching_frequency")
    return both[1 - both.index(estimate)]


@dataclass(frozen=True, slots=True)
class PhotoRow:
    path: Path
    verdict: str  # One of VERDICTS
    # Sentences on why the match, or only its exposure time, is not sure
    note: str = ""
    match: Match | None = field(default=None, compare=False, repr=False)  # None where there is none
    # Exposure time in seconds from the file's metadata
    noted_exposure: float | None = None
    # Lines read out for a picture, the photo's columns; 0 for an unreadable file
    lines: int = 0
    # Width and height of the upright picture in pixels; (0, 0) for an unreadable file
    size: tuple[int, int] = (0, 0)
    # ``"lines"`` or ``"columns"`` of the upright picture; empty for an unreadable file
    scanned_along: str = ""
    camera: str | None = None  # Maker and model
    # Value of the known parameter given for this photo, in SI units; None for the scene's
    given: float | None = None

    @property
    def readout_time(self) -> float | None:
        """That of the match, in seconds; None without one."""
        return None if self.match is None else self.match.readout_time

    @property
    def switching_frequency(self) -> float | None:
        """That of the match, in Hz; None without one."""
        return None if self.match is None else self.match.switching_frequency

    @property
    def exposure_time(self) -> float | None:
        """That of the match, in seconds; None without one."""
        return None if self.match is None else self.match.exposure_time

    @property
    def correlation(self) -> float | None:
        """That of the match; None without one."""
        return None if self.match is None else self.match.correlation

    @property
    def pattern(self) -> str:
        """The chips sent; empty without a match."""
        return "" if self.match is None else self.match.pattern

    def uncertainty(self, name: str) -> float | None:
        """Return the standard deviation of an estimate, None where it was not estimated."""
        return None if self.match is None else self.match.uncertainties.get(name)

    @property
    def exposure_verdict(self) -> str:
        """The verdict on the exposure time; empty where there is none."""
        return "" if self.match is None else self.match.exposure_verdict


@dataclass(frozen=True, slots=True)
class CombinedEstimate:
    """Weighted mean of several estimates."""

    value: float  # Weighted by the inverse variances
    # Standard deviation of a mean of independent estimates, times ``scale``
    uncertainty: float
    count: int
    # Sum of the squared differences from the mean, in standard deviations
    chi_square: float
    # Of a chi-square at least as large, if the standard deviations are right
    probability: float
    # At least 1, see `weighted_mean`: above 1 where the estimates scatter by more than their
    # standard deviations, or by so little that they may have an error in common
    scale: float
    # Indices of the estimates excluded as too far from the others
    outliers: tuple[int, ...] = ()

    @property
    def degrees_of_freedom(self) -> int:
        return self.count - 1

    @property
    def agrees(self) -> bool:
        """Whether the estimates agree within their standard deviations, at a level of 1 %."""
        return self.probability >= _MIN_PROBABILITY


_MIN_PROBABILITY = 0.01


@dataclass(frozen=True, slots=True)
class PhotoTable:
    """Several photos of one scene.

    Parameters
    ----------
    estimate
        The parameter that was measured: ``"readout_time"`` or ``"switching_frequency"``.
    rows
        One for each photo, in the given order.
    estimated, exposure_time
        Means over the sure photos, and over those with a sure exposure time; None without any, or
        where the photos differ in exposure time. ``outliers`` are indices of ``rows``.
    notes
        Sentences about the photos together.
    """

    scene: Scene
    estimate: str
    rows: tuple[PhotoRow, ...]
    estimated: CombinedEstimate | None
    exposure_time: CombinedEstimate | None
    notes: tuple[str, ...] = ()

    @property
    def known(self) -> str:
        """The parameter that was taken as known: the other one of the two."""
        return known_beside(self.estimate)

    def count(self, verdict: str) -> int:
        """Count the photos with a verdict."""
        return sum(row.verdict == verdict for row in self.rows)

    def is_outlier(self, place: int) -> bool:
        """Whether a photo was excluded from the mean as too far from the others."""
        return self.estimated is not None and place in self.estimated.outliers

    @property
    def rests_on_the_scene(self) -> bool:
        """Whether the scene's known value was used for any photo."""
        return any(row.given is None for row in self.rows)

    def is_counted(self, place: int) -> bool:
        """Whether a photo contributes to the mean."""
        sure = self.rows[place].verdict == SURE
        return self.estimated is not None and sure and not self.is_outlier(place)
