"""A camera's readout time, measured by the band that one flash leaves in a picture."""

from dataclasses import dataclass

from occ_model.results.fact import Fact
from occ_model.results.line_readout import LineReadout
from occ_model.scene.units import SECOND, Unit


@dataclass(frozen=True, eq=False, kw_only=True, slots=True)
class FlashMeasurement(LineReadout):
    """How fast a camera reads its lines, by the band of one flash.

    Parameters
    ----------
    flash
        Length of the flash in seconds, as given; ``uncertainties`` do not include its error.
    exposure_time
        In seconds, with its standard deviation among the ``uncertainties``.
    band, edge
        Lines at half of the band's height, and of each of its slopes.
    other_readout_time
        Readout time if the exposure were the shorter of both, or the longer; None if the exposure
        that the camera noted excludes it.
    """

    flash: float
    exposure_time: float
    band: float
    edge: float
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
            *self._readout_facts,
            Fact("exposure_time", "Exposure time", self._estimate("exposure_time")),
            Fact("band", "Band at half height", lines.format(self.band, 4)),
            Fact("edge", "Each of its slopes", lines.format(self.edge, 3)),
        )
