"""How far a decoder reaches in a scene."""

from dataclasses import dataclass

from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Trial:
    """What was counted at one value of a parameter.

    Parameters
    ----------
    value
        The parameter, in SI units.
    right, sent
        Bits read rightly, of so many.
    low, high
        The 95 % interval by Wilson of the rate behind them, percent.
    """

    value: float
    right: int
    sent: int
    low: float
    high: float

    @property
    def rate(self) -> float:
        """Success rate in percent."""
        return 100.0 * self.right / self.sent


@dataclass(frozen=True, slots=True)
class RangeEnd:
    """Where reading ends on one side.

    Parameters
    ----------
    works
        The last value at which the decoder reads.
    fails
        The first value beyond at which it does not; None where it reads to the end of what was
        searched.
    """

    works: Trial
    fails: Trial | None

    @property
    def value(self) -> float:
        """The last value at which the decoder reads, in SI units."""
        return self.works.value

    @property
    def width(self) -> float:
        """How far the value beyond lies: the true edge is in between. 0 where there is none."""
        return abs(self.fails.value - self.works.value) if self.fails else 0.0


@dataclass(frozen=True, slots=True)
class WorkingRange:
    """Between which values of a parameter a decoder reads a scene, all others as they are.

    Parameters
    ----------
    parameter
        Its name.
    searched
        The lowest value that was tried, and the highest.
    lowest, highest
        The ends of the interval in which the decoder reads: the one that holds the scene's own
        value, or lies nearest to it. None where it reads nowhere.
    failure
        None, or a sentence that says that it reads nowhere.
    """

    parameter: str
    searched: tuple[float, float]
    lowest: RangeEnd | None
    highest: RangeEnd | None
    failure: str | None = None


@dataclass(frozen=True, slots=True)
class Limits:
    """How far a decoder reaches in a scene.

    Parameters
    ----------
    scene, decoder
        The scene, and the decoder's name.
    rate
        Success rate in percent from which it counts as reading.
    images, seed
        Images at each value tried, and the seed of each.
    frequency, exposure
        Between which switching frequencies and which exposure times it reads.
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
