"""Reports of results: not more often than they can be shown, and complete at the end of a stage."""

from collections.abc import Callable

from occ_model.parallel.job import Listener
from occ_model.parallel.request import Run, StageProgress


class Reports:
    """Reports the results of each channel, at most once in an ``interval`` of seconds."""

    def __init__(
        self,
        listener: Listener,
        interval: float,
        stage_interval: float,
        clock: Callable[[], float],
    ) -> None:
        self._listener = listener
        self._interval, self._stage_interval = interval, stage_interval
        self._clock = clock
        self._last: dict[int, float] = {}

    def report(self, run: Run, stage: StageProgress) -> None:
        """Report the run's new results if it is time, or the stage is done."""
        now = self._clock()
        interval = self._stage_interval if stage.stage.uninterruptible else self._interval
        is_due = now - self._last.get(run.channel, -interval) >= interval
        if run.unreported and (stage.is_done or is_due):
            self._last[run.channel] = now
            results, run.unreported = run.unreported, []
            self._listener.results_ready(run.channel, run.number, results)
