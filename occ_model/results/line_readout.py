"""What all measurements of how fast a camera reads its lines have in common."""

from collections.abc import Mapping

import numpy as np

from occ_model.scene.units import SECOND, Unit


class LineReadout:
    """A measured readout time, with its error and the reasons to doubt it."""

    __slots__: tuple[str, ...] = ()

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

    def to_dict(self) -> dict[str, object]:
        """Return the result as numbers and texts in SI units, such as JSON takes."""
        answer: dict[str, object] = {"verdict": self.verdict, "reasons": list(self.reasons)}
        for name in self.__slots__:
            value = getattr(self, name)
            if not isinstance(value, np.ndarray):
                answer.setdefault(name, dict(value) if isinstance(value, Mapping) else value)
        return answer

    def _estimate(self, name: str, unit: Unit = SECOND) -> str:
        return unit.format_estimate(getattr(self, name), self.uncertainties[name])
