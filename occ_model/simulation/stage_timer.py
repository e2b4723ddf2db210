"""How long the stages of a simulation take."""

from time import perf_counter


class StageClock:
    """Adds up the time between one stage's end and the next one's under the latter's name."""

    def __init__(self) -> None:
        self.timings: dict[str, float] = {}
        self._last = perf_counter()

    def done(self, stage: str) -> None:
        """Note that a stage, or a part of it, has just ended."""
        now = perf_counter()
        self.timings[stage] = self.timings.get(stage, 0.0) + now - self._last
        self._last = now
