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
    # The 95 % interval of the success rate in percent, counted by images
    low: float
    high: float
    # Images tried: fewer than requested where the rate was out of reach
    images: int
    whole: int  # Images without a wrong bit

    @property
    def rate(self) -> float:
        return 100.0 * self.right / self.sent


@dataclass(frozen=True, slots=True)
class RangeEnd:
    """One end of an interval in which a decoder reads, confirmed by other images than found it."""

    works: Trial
    # A value beyond, with a 95 % interval below the required rate; None at the end of the search.
    fails: Trial | None
    # A value inside without a wrong bit and with a 95 % interval above the required rate; at the
    # end of the search `works`, if no bit was wrong. None where not found, or not searched for.
    inside: Trial | None = None
    # Whether the end was bisected; otherwise it is known to a step of the search
    is_bisected: bool = False
    # The 95 % interval of the true end; None where unknown
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
    # Where the decoder reads, rising, with gaps between them
    intervals: tuple[ReadInterval, ...]
    failure: str | None = None  # A sentence where it reads nowhere
    # The value with most bits read, where it reads nowhere; otherwise None
    best: Trial | None = None
    # Chips of an exposure at which the search ended because the decoder takes too long beyond
    most_chips: float | None = None
    # How often a plug-in has failed in the search, whose bits count as wrong; empty where none has
    faults: str = ""

    @property
    def lowest(self) -> RangeEnd | None:
        """The lowest end; None where it reads nowhere."""
        return self.intervals[0].lowest if self.intervals else None

    @property
    def highest(self) -> RangeEnd | None:
        """The highest end, beyond any gaps; None where it reads nowhere."""
        return self.intervals[-1].highest if self.intervals else None

    @property
    def gaps(self) -> tuple[tuple[RangeEnd, RangeEnd], ...]:
        """For each gap the end before it and the end after it."""
        return tuple((one.highest, other.lowest) for one, other in pairwise(self.intervals))


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits between which a decoder reads a scene.

    Parameters
    ----------
    rate
        Success rate in percent from which the scene counts as read.
    images, seed
        Images at each value tried, and their seed.
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

        Counted as if each picture showed a new payload, read as often as the scene's own: it counts
        once, and only without a wrong bit.
        """
        own, camera = self.frequency.own, self.scene.camera
        bits, readout_time = own.sent // own.images, camera.columns * camera.readout_time
        return bits_a_second(own.whole / own.images, bits, frames_a_second, readout_time)

    @property
    def highest_frequency(self) -> float | None:
        """The highest switching frequency in Hz, None where none is read."""
        return self.frequency.highest.value if self.frequency.highest else None

    @property
    def shortest_exposure(self) -> float | None:
        """The shortest exposure time in seconds, None where none is read."""
        return self.exposure.lowest.value if self.exposure.lowest else None

    @property
    def longest_exposure(self) -> float | None:
        """The longest exposure time in seconds, None where none is read."""
        return self.exposure.highest.value if self.exposure.highest else None
