"""Scale of a timeline: which part of its width a time lies at, and where its ticks stand."""

import math
from dataclasses import dataclass

from occ_gui.video.marks import Marks

_LEAST_SPACING = 80.0  # fewest pixels between two ticks


@dataclass(frozen=True, slots=True)
class TimelineScale:
    """The times at both ends, in seconds."""

    first: float = 0.0
    last: float = 0.0

    @classmethod
    def of(cls, frames: Marks) -> "TimelineScale":
        if not len(frames):
            return cls()
        return cls(float(frames.starts.min()), float(frames.ends.max()))

    @property
    def span(self) -> float:
        return self.last - self.first

    def share(self, time: float) -> float:
        """Return where a time lies, from 0 to 1 between the ends."""
        return (time - self.first) / self.span if self.span > 0.0 else 0.0

    def time(self, share: float) -> float:
        return self.first + share * self.span


def tick_step(span: float, width: float) -> tuple[float, int]:
    """Return the seconds between two ticks, and the decimals that tell them apart.

    ``span``: the time in view, in seconds; more than zero.
    ``width``: the pixels that it takes.
    """
    least = span * _LEAST_SPACING / max(width, 1.0)
    power = math.floor(math.log10(least))
    step = next(
        factor * 10.0**power for factor in (1, 2, 5, 10) if factor * 10.0**power >= least * 0.999
    )
    return step, max(0, -math.floor(math.log10(step * 1.001)))
