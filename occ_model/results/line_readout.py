"""What all measurements of how fast a camera reads its lines have in common."""

from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np

from occ_model.results.fact import Fact
from occ_model.scene.units import SECOND, Unit


@dataclass(frozen=True, eq=False, kw_only=True, slots=True)
class LineReadout:
    """A measured readout time, with its error and the reasons to doubt it.

    Parameters
    ----------
    readout_time, frame_readout_time
        Time from one line to the next, and of all lines, in seconds.
    uncertainties
        Standard deviations of the estimates, by name.
    scan_axis
        ``"lines"`` or ``"columns"`` of the upright picture: what the camera reads one by one.
    lines
        Number of them.
    reasons
        Sentences on why the measurement is doubtful; empty if it is sure.
    """

    readout_time: float
    frame_readout_time: float
    uncertainties: Mapping[str, float]
    scan_axis: str
    lines: int
    reasons: tuple[str, ...] = ()

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

    def to_dict(self) -> dict[str, object]:
        """Return the result as numbers and texts in SI units, such as JSON takes."""
        answer: dict[str, object] = {"verdict": self.verdict, "reasons": list(self.reasons)}
        for field in fields(self):
            value = getattr(self, field.name)
            if not isinstance(value, np.ndarray):
                answer.setdefault(field.name, dict(value) if isinstance(value, Mapping) else value)
        return answer

    @property
    def _readout_facts(self) -> tuple[Fact, Fact]:
        return (
            Fact("readout_time", "Readout time", self._estimate("readout_time")),
            Fact("frame_readout_time", "Frame's readout", self._estimate("frame_readout_time")),
        )

    def _estimate(self, name: str, unit: Unit = SECOND) -> str:
        return unit.format_estimate(getattr(self, name), self.uncertainties[name])
