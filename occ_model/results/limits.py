"""The working range of a decoder: the limits between which it reads a scene."""

from dataclasses import dataclass

from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Trial:
    """The bits counted at one value of a parameter.

    Parameters
    ----------
    value
        The parameter, in SI units.
    right, sent
        Bits read rightly, and bits sent.
    low, high
        Wilson's 95 % interval of the success rate, percent.
    images
        Images that were read: fewer than asked for where the rate could not be reached any more.
    """

    value: float
    right: int
    sent: int
    low: float
    high: float
    images: int

    @property
    def rate(self) -> float:
        """Success rate in percent."""
        return 100.0 * self.right / self.sent


@dataclass(frozen=True, slots=True)
class RangeEnd:
    """One end of a working range.

    Parameters
    ----------
    works
        The last value at which the decoder reads.
    fails
        The first value beyond, at which it does not; None where it reads to the end of the search.
    inside
        A value a little further inside at which every bit of all images was read; None where there
        is none near.
    """

    works: Trial
    fails: Trial | None
    inside: Trial | None = None

    @property
    def value(self) -> float:
        """The last value at which the decoder reads, in SI units."""
        return self.works.value

    @property
    def width(self) -> float:
        """Distance to the value beyond: the true end lies in between. 0 where there is none."""
        return abs(self.fails.value - self.works.value) if self.fails else 0.0


@dataclass(frozen=True, slots=True)
class WorkingRange:
    """The values of a parameter between which a decoder reads a scene, all others as they are.

    Parameters
    ----------
    parameter
        Its name.
    searched
        The lowest and the highest value tried.
    lowest, highest
        The ends of the interval in which the decoder reads: the one that contains the scene's own
        value, or is nearest to it. None where it reads nowhere.
    failure
        None, or a sentence that says that it reads nowhere.
    best
        Where it reads nowhere: the value at which it reads the most; else None.
    """

    parameter: str
    searched: tuple[float, float]
    lowest: RangeEnd | None
    highest: RangeEnd | None
    failure: str | None = None
    best: Trial | None = None


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
