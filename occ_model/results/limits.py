"""The working range of a decoder, and the theoretical limits."""

from dataclasses import dataclass

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
    """One end of an interval in which a decoder reads, found with images of its own."""

    # What is stated: the limit of the 95 % interval that is nearer to the range; without one, the
    # last value of the search that is read
    value: float
    works: Trial  # The images at a value inside or at the stated one
    fails: Trial | None  # The images at a value beyond; None at the end of the search
    # The 95 % interval of the true end, in the order outwards; None if known only to a step
    interval: tuple[float, float] | None = None

    @property
    def is_sure(self) -> bool:
        """Whether the images show that the stated value is read."""
        if self.fails is not None:
            return self.interval is not None
        return self.works.whole == self.works.images


@dataclass(frozen=True, slots=True)
class ReadInterval:
    """Interval of a parameter's values in which a decoder reads."""

    lowest: RangeEnd
    highest: RangeEnd


@dataclass(frozen=True, slots=True)
class WorkingRange:
    """Values of a parameter at which a decoder reads a scene, with the others unchanged."""

    parameter: str
    searched: tuple[float, float]  # Lowest and highest value of the search
    # Ratio of neighbouring values of the search: narrower gaps and intervals can be missed
    step: float
    own: Trial  # At the scene's own value
    # The intervals in which the decoder reads, in increasing order, with gaps between them
    intervals: tuple[ReadInterval, ...]
    failure: str | None = None  # A sentence if it reads nowhere
    # The value with the most bits read, if it reads nowhere; otherwise None
    best: Trial | None = None
    # Chips per exposure at which the search ended because the decoder would take too long
    most_chips: float | None = None
    # How often a plug-in has failed in the search, whose bits count as wrong; empty if none has
    faults: str = ""

    @property
    def widest(self) -> ReadInterval | None:
        """The interval of the largest ratio of its ends; None if it reads nowhere."""
        return max(
            self.intervals, key=lambda each: each.highest.value / each.lowest.value, default=None
        )

    @property
    def lowest(self) -> RangeEnd | None:
        """The value down to which it reads without a gap; None if it reads nowhere."""
        return self.widest.lowest if self.widest else None

    @property
    def highest(self) -> RangeEnd | None:
        """The value up to which it reads without a gap; None if it reads nowhere."""
        return self.widest.highest if self.widest else None

    @property
    def others(self) -> tuple[ReadInterval, ...]:
        """The intervals that gaps separate from the widest one."""
        return tuple(each for each in self.intervals if each is not self.widest)


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

        It assumes that each picture has a new payload, which is read as often as the scene's own. A
        payload counts only without a wrong bit.
        """
        trial, camera = self.frequency.own, self.scene.camera
        bits, readout_time = trial.sent // trial.images, camera.columns * camera.readout_time
        return bits_a_second(trial.whole / trial.images, bits, frames_a_second, readout_time)

    @property
    def highest_frequency(self) -> float | None:
        """The switching frequency in Hz up to which it reads without a gap, None if none is."""
        return self.frequency.highest.value if self.frequency.highest else None

    @property
    def shortest_exposure(self) -> float | None:
        """The exposure time in seconds down to which it reads without a gap, None if none is."""
        return self.exposure.lowest.value if self.exposure.lowest else None

    @property
    def longest_exposure(self) -> float | None:
        """The exposure time in seconds up to which it reads without a gap, None if none is."""
        return self.exposure.highest.value if self.exposure.highest else None


@dataclass(frozen=True, slots=True)
class TheoryLimits:
    """Theoretical limits of one parameter, with the others unchanged."""

    band_model: float  # Where the band model ends: t = t_LED
    null: float  # Where an alternating pattern has no stripes: t = 2 t_LED
    # Frequency below which two packets do not fit into the panel's image; None for an exposure time
    # or without a panel in view
    two_packets: float | None = None
    # Exposure time above which the lit panel is white, infinite without light; None for a frequency
    saturation: float | None = None


@dataclass(frozen=True, slots=True)
class Advice:
    """How fast a scene can send to one decoder, and how long it can be exposed."""

    limits: Limits
    # Theoretical limits of the frequency and of the exposure time
    frequency: TheoryLimits
    exposure: TheoryLimits
    cause: str = ""  # Sentences on why the scene itself is not read; empty if it is, or if unknown
