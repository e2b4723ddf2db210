"""A camera's readout time, measured by the bars that lamps on the mains make in its pictures."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.results.fact import Fact
from occ_model.results.line_readout import LineReadout
from occ_model.scene.light_words import MAINS_HARMONIC
from occ_model.scene.units import HERTZ, NONE, PERCENT, SECOND


@dataclass(frozen=True, eq=False, kw_only=True, slots=True)
class CameraMeasurement(LineReadout):
    """How fast a camera reads its lines, by bars of lamps on the mains.

    Parameters
    ----------
    mains_frequency
        Frequency of the mains in Hz, as given; the light swings at twice that.
    bars
        Cycles of the light while a frame is read, with their standard deviation among the
        ``uncertainties``, which include that of the mains' frequency.
    pictures
        Number of pictures: 1 or 2.
    depth
        Depth of the bars where they are deepest, (brightest - darkest) / (brightest + darkest): of
        one picture, or of the quotient of two.
    longest_exposure
        Exposure time in seconds above which no light makes bars of this depth; None for two
        pictures.
    waves : ndarray of float64, shape (tiles, points)
        The fitted bars in equal tiles across the lines, from the first line to the last: the
        natural logarithm of the light, or of the quotient, about its mean.
    other_bars
        Number of bars that explains the pictures second best; None if there is none.
    """

    mains_frequency: float
    bars: float
    pictures: int
    depth: float
    longest_exposure: float | None
    waves: FloatArray
    other_bars: float | None = None

    @property
    def light_frequency(self) -> float:
        """Cycles of the light a second: twice those of the mains."""
        return MAINS_HARMONIC * self.mains_frequency

    @property
    def assumption(self) -> str:
        """What the result rests on, in one sentence."""
        return (
            f"Assumed: the mains have {HERTZ.format(self.mains_frequency, 4)}, and the picture is "
            f"not cropped. If it was made smaller, the time from line to line is that of its "
            f"{self.lines:,} {self.scan_axis}, not of the sensor's; the frame's is right."
        )

    @property
    def facts(self) -> tuple[Fact, ...]:
        """The rows of the result."""
        light = HERTZ.format(self.light_frequency, 4)
        of_what = "one picture" if self.pictures == 1 else "the quotient of two pictures"
        rows = [
            *self._readout_facts,
            Fact("bars", "Bars a frame", f"{self._estimate('bars', NONE)}, of light at {light}"),
            Fact("scan_axis", "Read one by one", f"{self.lines:,} {self.scan_axis}"),
            Fact("depth", "Depth of the bars", f"{PERCENT.format(self.depth, 2)} in {of_what}"),
        ]
        if self.longest_exposure is not None:
            text = f"at most {SECOND.format(self.longest_exposure, 3)}"
            rows.append(Fact("exposure_time", "Exposure time", text))
        return tuple(rows)
