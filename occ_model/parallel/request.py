"""Requests for work: the stages of each, and which of their jobs wait or are with workers."""

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from occ_model.parallel.job import Job, Stage, Stages


class StageProgress:
    """A stage that has begun: the jobs that wait, and how many are with workers."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.in_flight = 0
        self._coming = iter(stage.jobs)
        self._waiting: deque[Job] = deque()

    @property
    def has_waiting(self) -> bool:
        if not self._waiting:
            job = next(self._coming, None)
            if job is not None:
                self._waiting.append(job)
        return bool(self._waiting)

    @property
    def is_done(self) -> bool:
        return not (self.has_waiting or self.in_flight)

    def take(self) -> Job:
        """Take the first waiting job, which is with a worker from now on."""
        self.in_flight += 1
        return self._waiting.popleft()

    def put_back(self, job: Job) -> None:
        """Return a job to the head of those that wait."""
        self.in_flight -= 1
        self._waiting.appendleft(job)


@dataclass(eq=False, slots=True)
class Run:
    channel: int
    number: int  # The number of the run; later runs of a channel have higher ones
    stages: Stages
    begun: list[StageProgress] = field(default_factory=list)
    unreported: list[Any] = field(default_factory=list)
    _coming: Iterator[Stage] | None = None

    def advance(self) -> None:
        """Begin the next stage once all jobs of those before it are with workers."""
        if self._coming is None:
            self._coming = iter(self.stages())
        while self.waiting_stage is None:
            stage = next(self._coming, None)
            if stage is None:
                return
            progress = StageProgress(stage)
            if progress.has_waiting:
                self.begun.append(progress)

    @property
    def waiting_stage(self) -> StageProgress | None:
        return next((stage for stage in self.begun if stage.has_waiting), None)

    @property
    def is_done(self) -> bool:
        """Whether all jobs of the stages that have begun have a result."""
        return all(stage.is_done for stage in self.begun)

    @property
    def is_uninterruptible(self) -> bool:
        """Whether a stage is under way that must be completed."""
        return any(stage.stage.uninterruptible for stage in self.begun)
