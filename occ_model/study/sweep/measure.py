"""Measure the points of a study that its results file lacks, and report the progress."""

import math
from collections.abc import Callable, Iterable
from concurrent.futures import Executor
from contextlib import ExitStack, closing
from pathlib import Path
from time import perf_counter
from typing import TypeAlias

from occ_model.results.sweep_request import MOST_JOBS
from occ_model.scene.argument_checks import check_count
from occ_model.study.sweep.request_check import processes_for
from occ_model.study.sweep.results_file import Point, ResultsFile, TableText
from occ_model.study.sweep.workers import StudyWork, measure_anywhere

Progress: TypeAlias = Callable[[int, int, float], object]  # points done, all points, seconds left


REPORT_PERIOD = 0.2  # seconds between reports of the progress during a long point


def measure_study(  # noqa: PLR0913 - the study, and how it is measured
    work: StudyWork[Point],
    table: TableText[Point],
    order: Iterable[int],
    add_point: Callable[[Point], object],
    all_lines: Callable[[], Iterable[str]],
    *,
    executor: Executor | None,
    jobs: int,
    progress: Progress | None,
    results: str | Path | None,
) -> None:
    """Measure the points of a study that its results file does not contain yet, in a given order.

    ``add_point``: called with each point, including those of the file. ``all_lines``: returns the
    lines of all points in the order of the study. For the other arguments see :func:`run_sweep`.
    """
    check_count("jobs", jobs, 1, MOST_JOBS)
    reporter, is_measured = StudyProgress(table.point_count, progress), bytearray(table.point_count)
    with ExitStack() as stack:
        file = (
            stack.enter_context(ResultsFile(Path(results), table)) if results is not None else None
        )
        if file is not None:
            for point in file.read_points():
                is_measured[point.index] = True
                add_point(point)
            reporter.start(sum(is_measured))
        indices_left = (index for index in order if not is_measured[index])
        jobs = processes_for(jobs, table.point_count - sum(is_measured))
        points = measure_anywhere(work, indices_left, executor, jobs, reporter.report_if_due)
        # Always closed here, because workers that are not closed would continue.
        stack.enter_context(closing(points))
        for point in points:
            if file is not None:
                file.append(point)
            add_point(point)
            reporter.count_point()
        if file is not None:
            file.finish(all_lines())


class StudyProgress:
    """Measures the progress of a study and its time left, and reports both."""

    def __init__(self, total: int, progress: Progress | None) -> None:
        self._progress = progress
        self._total = total
        self._done = self._from_file = 0
        self._start_time = self._report_time = perf_counter()

    def start(self, from_file: int) -> None:
        self._done = self._from_file = from_file
        self._start_time = self._report_time = perf_counter()
        if from_file:
            self._report()

    def count_point(self) -> None:
        self._done += 1
        self._report()

    def report_if_due(self) -> None:
        """Report the progress again if the last report was long ago."""
        if perf_counter() - self._report_time >= REPORT_PERIOD:
            self._report()

    def _report(self) -> None:
        self._report_time = perf_counter()
        if self._progress is None:
            return
        point_count = self._done - self._from_file
        seconds_a_point = (
            (self._report_time - self._start_time) / point_count if point_count else math.nan
        )
        self._progress(self._done, self._total, seconds_a_point * (self._total - self._done))
