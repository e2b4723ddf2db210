"""Timing of a simulation's stages."""

from collections.abc import Callable, Mapping, Sequence
from math import fsum
from time import perf_counter
from typing import Self


class StageTimer:
    """Adds up seconds by stage, without gaps; ``before`` are the times of earlier stages."""

    def __init__(
        self, before: Mapping[str, float] | None = None, clock: Callable[[], float] | None = None
    ) -> None:
        self.timings: dict[str, float] = dict(before or {})
        self._now = clock or perf_counter
        self._last = self._now()

    def end_stage(self, stage: str) -> None:
        """Add the time since the last stage ended to that of this stage."""
        self._add(stage, self.skip())

    def skip(self) -> float:
        """Return the time since the last stage ended, and count it for none."""
        before, self._last = self._last, self._now()
        return self._last - before

    def end_parallel_stages(self, timers: Sequence[Self]) -> None:
        """Divide the time since the last stage ended among parallel ones, by their thread time."""
        passed = self.skip()
        taken: dict[str, float] = {}
        for timer in timers:
            for stage, seconds in timer.timings.items():
                taken[stage] = taken.get(stage, 0.0) + seconds
        total = fsum(taken.values())
        for stage, seconds in taken.items():
            self._add(stage, passed * seconds / total if total else passed / len(taken))

    def _add(self, stage: str, seconds: float) -> None:
        self.timings[stage] = self.timings.get(stage, 0.0) + seconds
