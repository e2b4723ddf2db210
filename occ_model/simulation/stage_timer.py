"""Time the stages of a simulation."""

from collections.abc import Mapping, Sequence
from math import fsum
from time import perf_counter
from typing import Self


class StageTimer:
    """Adds up seconds by stage, without gaps; ``before``: stages that ended earlier."""

    def __init__(self, before: Mapping[str, float] | None = None) -> None:
        self.timings: dict[str, float] = dict(before or {})
        self._last = perf_counter()

    def stage_ended(self, stage: str) -> None:
        """Add the time since the last stage ended to that of this stage, or part of it."""
        now = perf_counter()
        self._add(stage, now - self._last)
        self._last = now

    def begin(self) -> None:
        """Skip the time since the last stage ended: what follows is done in another thread."""
        self._last = perf_counter()

    def parallel_stages_ended(self, timers: Sequence[Self]) -> None:
        """Divide the time since the last stage among parallel ones, by their time in threads."""
        now = perf_counter()
        passed, self._last = now - self._last, now
        taken: dict[str, float] = {}
        for timer in timers:
            for stage, seconds in timer.timings.items():
                taken[stage] = taken.get(stage, 0.0) + seconds
        total = fsum(taken.values())
        for stage, seconds in taken.items():
            self._add(stage, passed * seconds / total if total else passed / len(taken))

    def _add(self, stage: str, seconds: float) -> None:
        self.timings[stage] = self.timings.get(stage, 0.0) + seconds
