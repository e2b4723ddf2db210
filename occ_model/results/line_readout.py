"""What all measurements of how fast a camera reads its lines have in common."""

from collections.abc import Mapping

from occ_model.scene.units import SECOND, Unit


class LineReadout:
    """A measured readout time, with its error and the reasons to doubt it."""

    __slots__ = ()

    readout_time: float
    frame_readout_time: float
    uncertainties: Mapping[str, float]
    scan_axis: str
    lines: int
    reasons: tuple[str, ...]

    @property
    def verdict(self) -> str:
        """``"sure"``, or ``"doubtful"`` if there is a reason to doubt the measurement."""
        return "doubtful" if self.reasons else "sure"

    @property
    def sentence(self) -> str:
        """The answer in one sentence."""
        return (
            f"Your camera reads {'a line' if self.scan_axis == 'lines' else 'a column'} in "
            f"{self._estimate('readout_time')}, and a frame of {self.lines:,} in "
            f"{self._estimate('frame_readout_time')}: {self.verdict}."
        )

    def _estimate(self, name: str, unit: Unit = SECOND) -> str:
        return unit.format_estimate(getattr(self, name), self.uncertainties[name])
