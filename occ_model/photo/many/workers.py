"""Match files in several processes, and go on where one of them ends a process."""

import warnings
from collections.abc import Generator, Iterable, Iterator
from itertools import chain
from pathlib import Path
from typing import Any, TypeAlias

from occ_model.parallel.job import Heartbeat, Job, Stage, Workers, WorkersLostError
from occ_model.parallel.request import Run
from occ_model.parallel.scheduler import Scheduler
from occ_model.photo.many.row import MatchSettings, row_of
from occ_model.results.photo_table import UNREADABLE, PhotoRow

PRELOAD = "occ_model.photo.many.row"
"""The module that a worker process needs."""

_BEAT = 0.2  # seconds between two heartbeats while this process waits for workers

Files: TypeAlias = Iterable[tuple[int, Path]]
"""The files to match, each with its place in the table."""

Rows: TypeAlias = Generator[tuple[int, PhotoRow], None, None]
"""Rows of the table, each with its place."""


def rows_by_workers(files: Files, settings: MatchSettings, jobs: int, heartbeat: Heartbeat) -> Rows:
    """Match files in processes, in the order in which they are ready.

    Where processes end again and again, the files that they had are matched alone, and one that
    ends its process even then becomes a row that says so. Where the system has no processes to
    give, a thread of this one matches the files; where they cannot work, this process does, with
    a ``RuntimeWarning``.
    """
    waiting = iter(files)
    while True:
        progress = _Progress(waiting, settings)
        yield from _finished(progress, jobs, heartbeat)
        if progress.lost_by is None:
            return
        if not _has_workers(settings, heartbeat):
            warnings.warn(
                f"Workers end before they work ({progress.lost_by.reason}); this process matches "
                "the photos alone.",
                RuntimeWarning,
                stacklevel=2,
            )
            for place, path in chain(progress.sent.items(), waiting):
                yield row_of(place, path, settings, heartbeat)
            return
        for place, path in progress.sent.items():
            alone = _Progress(iter([(place, path)]), settings)
            yield from _finished(alone, 1, heartbeat)
            if alone.lost_by is not None:
                reason = alone.lost_by.reason
                note = f"The process that reads and matches it ended each time ({reason})."
                yield place, PhotoRow(path, UNREADABLE, note)


def _has_workers(settings: MatchSettings, heartbeat: Heartbeat) -> bool:
    """Whether a worker can do anything at all: it is given a path that is not a file."""
    trial = _Progress(iter([(0, Path())]), settings)
    return any(True for _ in _finished(trial, 1, heartbeat))


def _finished(progress: "_Progress", jobs: int, heartbeat: Heartbeat) -> Rows:
    # Importing what starts processes takes time.
    from occ_model.parallel.process_pool import ProcessPool
    from occ_model.parallel.worker_thread import WorkerThread

    def start() -> Workers:
        return ProcessPool(jobs, PRELOAD)

    scheduler = Scheduler(start, progress, fallback=WorkerThread)
    scheduler.put(Run(0, 1, lambda: (Stage(0, progress.jobs()),)))
    try:
        while not progress.is_ended:
            heartbeat()
            scheduler.step(_BEAT)
            yield from progress.newly_matched()
    finally:
        scheduler.end_workers()
    if progress.error is not None:
        raise progress.error


class _Progress:
    """The files that are to be sent, that workers have, and that are matched."""

    def __init__(self, files: Iterator[tuple[int, Path]], settings: MatchSettings) -> None:
        self._files = files
        self._settings = settings
        self._matched: list[tuple[int, PhotoRow]] = []
        self.sent: dict[int, Path] = {}
        self.is_ended = False
        self.lost_by: WorkersLostError | None = None
        self.error: Exception | None = None

    def jobs(self) -> Iterator[Job]:
        """Make a job of each file, only when it is needed."""
        for place, path in self._files:
            self.sent[place] = path
            yield Job(row_of, (place, path, self._settings))

    def newly_matched(self) -> list[tuple[int, PhotoRow]]:
        """Return the rows since the last call."""
        matched, self._matched = self._matched, []
        return matched

    def results_ready(self, _channel: int, _run: int, results: list[Any]) -> None:
        """Take the rows of jobs that have come back."""
        for place, row in results:
            del self.sent[place]
            self._matched.append((place, row))

    def finished(self, _channel: int, _run: int) -> None:
        """Note that all files are matched."""
        self.is_ended = True

    def failed(self, _channel: int, _run: int, error: Exception) -> None:
        """Note that workers match no more, and why."""
        self.is_ended = True
        if isinstance(error, WorkersLostError):
            self.lost_by = error
        else:
            self.error = error

    def workers_replaced(self, _channel: int, _run: int) -> None:
        """Do nothing: the work goes on."""

    def workers_missing(self, _channel: int, _run: int, _error: Exception) -> None:
        """Do nothing: the thread does the work."""
