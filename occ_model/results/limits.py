"""The working range of a decoder: the intervals of a parameter in which it reads a scene."""

from dataclasses import dataclass
from itertools import pairwise

from occ_model.results.bit_errors import FRAMES_A_SECOND, bits_a_second
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Trial:
    """The bits counted at one value of a parameter."""

    value: float  # The parameter, in SI units
    right: int
    sent: int
    # The 95 % interval of the success rate, percent, which counts images
    low: float
    high: float
    # Images that were tried: fewer than asked for where the rate could not be reached any more
    images: int
    whole: int  # Images of which every bit was read

    @property
    def rate(self) -> float:
        """Success rate in percent."""
        return 100.0 * self.right / self.sent


def stated_end(works: Trial, interval: tuple[float, float] | None) -> float:
    """Return the value at which an end's images read, or the nearest that more images allow."""
    if interval is None:
        return works.value
    return min(max(works.value, interval[0]), interval[1])


@dataclass(frozen=True, slots=True)
class RangeEnd:
    """One end of an interval in which a decoder reads.

    Its images have not chosen it: those that did are others.
    """

    works: Trial
    # A value beyond, at which it surely does not: the 95 % interval of the rate lies below the rate
    # asked for. None where it reads to the end of the search.
    fails: Trial | None
    # A value inside, at which it surely reads: every bit of so many images that the 95 % interval
    # lies above the rate asked for. At the end of the search ``works``, if every bit was read. None
    # where there is none, or it was not looked for.
    inside: Trial | None = None
    # Whether the end was found by bisection; otherwise it is known to a step of the search
    is_bisected: bool = False
    # The values between which the true end lies, with 95 %; None where that is not known
    interval: tuple[float, float] | None = None

    @property
    def value(self) -> float:
        """The last value at which the decoder reads, as :func:`stated_end` gives it."""
        return stated_end(self.works, self.interval)


@dataclass(frozen=True, slots=True)
class ReadInterval:
    """Values of a parameter, from a lowest to a highest, at which a decoder reads."""

    lowest: RangeEnd
    highest: RangeEnd


@dataclass(frozen=True, slots=True)
class WorkingRange:
    """The values of a parameter at which a decoder reads a scene, all others as they are."""

    parameter: str
    searched: tuple[float, float]
    # Ratio of neighbouring values of the search: a gap or an interval narrower than that can be
    # missed
    step: float
    own: Trial
    # Where the decoder reads, rising; between them are gaps. Empty where it reads nowhere.
    intervals: tuple[ReadInterval, ...]
    failure: str | None = None  # None, or a sentence that says that it reads nowhere
    # Where it reads nowhere: the value at which it reads the most; else None
    best: Trial | None = None
    # The chips of an exposure at which the search ended, as the decoder takes too long beyond; None
    # where that has not shortened it
    most_chips: float | None = None

    @property
    def lowest(self) -> RangeEnd | None:
        """The lowest end of all; None where it reads nowhere."""
        return self.intervals[0].lowest if self.intervals else None

    @property
    def highest(self) -> RangeEnd | None:
        """The highest end of all, beyond any gaps; None where it reads nowhere."""
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
    scene, decoder
        The scene, and the decoder's name.
    rate
        Least success rate in percent that counts as reading.
    images, seed
        Images at each value tried, and the seed of each.
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

        Each picture shows another payload, and counts where all its bits are read: repeats of a
        payload within a picture count once.
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
