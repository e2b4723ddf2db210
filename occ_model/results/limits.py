"""The working range of a decoder: the intervals of a parameter in which it reads a scene."""

from dataclasses import dataclass
from itertools import pairwise

from occ_model.results.bit_errors import FRAMES_A_SECOND, bits_a_second
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Trial:
    """The bits counted at one value of a parameter."""

    value: float  # Of the parameter, in SI units
    right: int
    sent: int
    # The 95 % interval of the success rate in percent, by the number of images
    low: float
    high: float
    # Images tried; fewer than requested if the rate was out of reach
    images: int
    whole: int  # Images without a wrong bit

    @property
    def rate(self) -> float:
        return 100.0 * self.right / self.sent


@dataclass(frozen=True, slots=True)
class RangeEnd:
    """One end of an interval in which a decoder reads, confirmed by new images."""

    works: Trial
    # A value beyond, whose 95 % interval is below the required rate; None at the end of the search
    fails: Trial | None
    # A value inside without a wrong bit, whose 95 % interval is above the required rate; at the end
    # of the search it is ``works``, if no bit was wrong. None if not found, or not searched for
    inside: Trial | None = None
    # Whether the end was bisected; otherwise it is known only to a step of the search
    is_bisected: bool = False
    # The 95 % interval of the true end; None if unknown
    interval: tuple[float, float] | None = None

    @property
    def value(self) -> float:
        """The last value at which the decoder reads, confirmed and within the interval."""
        low, high = self.interval or (self.works.value, self.works.value)
        return min(max(self.works.value, low), high)


@dataclass(frozen=True, slots=True)
class ReadInterval:
    """Interval of a parameter's values in which a decoder reads."""

    lowest: RangeEnd
    highest: RangeEnd


@dataclass(frozen=True, slots=True)
class WorkingRange:
    """Values of a parameter at which a decoder reads a scene, the others unchanged."""

    parameter: str
    searched: tuple[float, float]
    # Ratio of neighbouring values of the search: narrower gaps and intervals can be missed
    step: float
    own: Trial
    # The intervals in which the decoder reads, in increasing order, with gaps between them
    intervals: tuple[ReadInterval, ...]
    failure: str | None = None  # A sentence if it reads nowhere
    # The value with the most bits read, if it reads nowhere; otherwise None
    best: Trial | None = None
    # Chips an exposure at which the search ended because the decoder would take too long
    most_chips: float | None = None
    # How often a plug-in has failed in the search, whose bits count as wrong; empty if none has
    faults: str = ""

    @property
    def lowest(self) -> RangeEnd | None:
        """The lowest end; None if it reads nowhere."""
        return self.intervals[0].lowest if self.intervals else None

    @property
    def highest(self) -> RangeEnd | None:
        """The highest end, beyond any gaps; None if it reads nowhere."""
        return self.intervals[-1].highest if self.intervals else None

    @property
    def gaps(self) -> tuple[tuple[RangeEnd, RangeEnd], ...]:
        """For each gap, the end before it and the end after it."""
        return tuple((one.highest, other.lowest) for one, other in pairwise(self.intervals))


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits between which a decoder reads a scene.

    Parameters
    ----------
    rate
        Success rate in percent that counts as read.
    images, seed
        Images at each value that is tried, and their seed.
    frequency, exposure
        The switching frequencies and the exposure times at which it reads.
    """

    scene: Scene
    decoder: str
    rate: float
    images: int
    seed: int
    frequency: WorkingRange
    exposure: WorkingRange

    def bits_a_second(self, frames_a_second: float = FRAMES_A_SECOND) -> float:
        """Return the net bits a second at the scene's own frequency and exposure.

        It counts as if each picture had a new payload that is read as often as the scene's own; a
        payload counts once, and only without a wrong bit.
        """
        own, camera = self.frequency.own, self.scene.camera
        bits, readout_time = own.sent // own.images, camera.columns * camera.readout_time
        return bits_a_second(own.whole / own.images, bits, frames_a_second, readout_time)

    @property
    def highest_frequency(self) -> float | None:
        """The highest switching frequency in Hz that is read, None if none is."""
        return self.frequency.highest.value if self.frequency.highest else None

    @property
    def shortest_exposure(self) -> float | None:
        """The shortest exposure time in seconds that is read, None if none is."""
        return self.exposure.lowest.value if self.exposure.lowest else None

    @property
    def longest_exposure(self) -> float | None:
        """The longest exposure time in seconds that is read, None if none is."""
        return self.exposure.highest.value if self.exposure.highest else None
