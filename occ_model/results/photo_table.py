"""The table of several photos that were matched, and what they measured together."""

from dataclasses import dataclass, field
from pathlib import Path

from occ_model.results.match import Match
from occ_model.scene.scene import Scene

SURE, DOUBTFUL, REFUSED, UNREADABLE = "sure", "doubtful", "refused", "unreadable"
"""Verdicts on a photo: those of a match, no match, and a file that cannot be read."""

VERDICTS = (SURE, DOUBTFUL, REFUSED, UNREADABLE)


def known_beside(estimate: str) -> str:
    """Name the parameter that is known where the other of the two is estimated."""
    both = ("readout_time", "switching_frequency")
    return both[1 - both.index(estimate)]


@dataclass(frozen=True, slots=True)
class PhotoRow:
    """What was found in one photo."""

    path: Path
    verdict: str  # One of VERDICTS
    # Why it, or its exposure time alone, is not sure, in sentences; empty where all of it is
    note: str = ""
    match: Match | None = field(default=None, compare=False, repr=False)  # None where there is none
    # Seconds, as the camera noted it in the file; None where it did not
    noted_exposure: float | None = None
    # Lines that the shutter reads out in a picture: the photo's columns; 0 of an unreadable one
    lines: int = 0
    # Width and height of the upright picture in pixels; (0, 0) of an unreadable one
    size: tuple[int, int] = (0, 0)
    # ``"lines"`` or ``"columns"`` of the upright picture; empty of an unreadable one
    scanned_along: str = ""
    camera: str | None = None  # The camera's maker and model, None where it is not known
    # The value of the known parameter that was given for this photo alone, in SI units; None where
    # the scene's was taken
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
    """One value from several estimates of it."""

    value: float  # The mean, weighted by the inverse variances
    # Its standard deviation: that of a mean of independent estimates, times ``scale``
    uncertainty: float
    count: int
    # Sum of squares of the differences from the mean, each in its standard deviations
    chi_square: float
    # Of a chi-square that is as large or larger, where the standard deviations are right
    probability: float
    # At least 1, as weighted_mean says: above 1 where the estimates scatter by more than their
    # standard deviations, or by less, so that they may share an error
    scale: float
    # Places of the estimates that were left out, as too far from the others
    outliers: tuple[int, ...] = ()

    @property
    def degrees_of_freedom(self) -> int:
        """Degrees of freedom of chi-square."""
        return self.count - 1

    @property
    def agrees(self) -> bool:
        """Whether the estimates agree within their standard deviations, at a level of 1 %."""
        return self.probability >= _LEAST_PROBABILITY


_LEAST_PROBABILITY = 0.01


@dataclass(frozen=True, slots=True)
class PhotoTable:
    """Several photos of one scene.

    Parameters
    ----------
    scene
        The scene that the photos were matched with.
    estimate
        The parameter that was measured: ``"readout_time"`` or ``"switching_frequency"``.
    rows
        One for each photo, in the order in which they were given.
    estimated, exposure_time
        The estimate from all sure photos, and the exposure time from those of them in which it is
        sure, too; None where there are none, or for an exposure time that the photos do not share.
        ``outliers`` are places in ``rows``.
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
        """Whether the photo at a place was left out of the mean as too far from the others."""
        return self.estimated is not None and place in self.estimated.outliers

    @property
    def rests_on_the_scene(self) -> bool:
        """Whether the known value of the scene was taken for any of the photos."""
        return any(row.given is None for row in self.rows)

    def is_counted(self, place: int) -> bool:
        """Whether the photo at a place is in the mean."""
        sure = self.rows[place].verdict == SURE
        return self.estimated is not None and sure and not self.is_outlier(place)
