"""A camera's readout time, measured by the band that one flash leaves in a picture."""

from collections.abc import Mapping
from dataclasses import dataclass

from occ_model.results.fact import Fact
from occ_model.results.line_readout import LineReadout
from occ_model.scene.units import SECOND, Unit


@dataclass(frozen=True, eq=False, slots=True)
class FlashMeasurement(LineReadout):
    """How fast a camera reads its lines, by the band of one flash.

    Parameters
    ----------
    flash
        Length of the flash in seconds, as given.
    readout_time, frame_readout_time
        Time from one line to the next, and of all lines, in seconds.
    exposure_time
        In seconds.
    uncertainties
        Standard deviations of these three, by name; that of the flash's length is not among them.
    band, edge
        Lines at half of the band's height, and of each of its slopes.
    scan_axis
        ``"lines"`` or ``"columns"`` of the upright picture: what the camera reads one by one.
    lines
        Number of them.
    reasons
        Sentences on why the measurement is doubtful; empty if it is sure.
    other_readout_time
        Readout time if the exposure were the shorter of both, or the longer; None if the exposure
        that the camera noted excludes it.
    """

    flash: float
    readout_time: float
    frame_readout_time: float
    exposure_time: float
    uncertainties: Mapping[str, float]
    band: float
    edge: float
    scan_axis: str
    lines: int
    reasons: tuple[str, ...] = ()
    other_readout_time: float | None = None

    @property
    def assumption(self) -> str:
        """What the result rests on, in one sentence."""
        return (
            f"Assumed: the flash lasts {SECOND.format(self.flash, 4)} and is equally bright all "
            "the time. If its length is wrong by 1 %, so is the readout time."
        )

    @property
    def facts(self) -> tuple[Fact, ...]:
        """The rows of the result."""
        lines = Unit(self.scan_axis)
        return (
            Fact("readout_time", "Readout time", self._estimate("readout_time")),
            Fact("frame_readout_time", "Frame's readout", self._estimate("frame_readout_time")),
            Fact("exposure_time", "Exposure time", self._estimate("exposure_time")),
            Fact("band", "Band at half height", lines.format(self.band, 4)),
            Fact("edge", "Each of its slopes", lines.format(self.edge, 3)),
        )
