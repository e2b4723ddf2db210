"""Time the stages of a simulation."""

from time import perf_counter


class StageTimer:
    """Adds up the seconds that each stage takes, by its name."""

    def __init__(self) -> None:
        self.timings: dict[str, float] = {}
        self._last = perf_counter()

    def stage_ended(self, stage: str) -> None:
        """Add the time since the last stage ended to that of this stage, or part of it."""
        now = perf_counter()
        self.timings[stage] = self.timings.get(stage, 0.0) + now - self._last
        self._last = now
