"""Laws of a sweep's workers: the table does not depend on who measures, dies or cannot start."""

import errno
import gc
import math
import multiprocessing
import multiprocessing.synchronize
import os
import signal
import tempfile
import weakref
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import pytest
from model.study.sweep.conftest import AXES, BOTH

import occ_model as occ
from occ_model.parallel.job import Job, JobResult
from occ_model.parallel.process_pool import process_context
from occ_model.results.sweep import SweepTable
from occ_model.scene.scene import Scene
from occ_model.study.sweep import sweep
from occ_model.study.sweep.workers import GivenExecutor


def kill_once(killed: list[int]) -> Callable[[int, int, float], None]:
    """Return a progress callback that kills one worker after the first point."""

    def progress(done: int, _total: int, _left: float) -> None:
        if done and not killed:
            worker = multiprocessing.active_children()[0]
            assert worker.pid is not None
            os.kill(worker.pid, signal.SIGKILL)
            killed.append(worker.pid)

    return progress


def test_two_processes_of_which_one_is_killed_give_the_same_table(
    scene: Scene, table: SweepTable
) -> None:
    killed: list[int] = []
    kill = kill_once(killed)
    told: list[int] = []

    def progress(done: int, total: int, left: float) -> None:
        told.append(done)
        assert total == 12
        assert math.isnan(left) if done == 0 else left >= 0.0
        kill(done, total, left)

    assert occ.sweep(scene, AXES, 3, BOTH, 7, jobs=2, progress=progress) == table
    assert len(killed) == 1
    assert told == sorted(told)
    assert told[-1] == 12


def test_threads_give_the_same_table(scene: Scene, table: SweepTable) -> None:
    with ThreadPoolExecutor(2) as executor:
        assert occ.sweep(scene, AXES, 3, BOTH, 7, executor=executor) == table


def test_a_long_path_of_the_temporary_folder_does_not_prevent_workers(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A server's socket does not fit into such a path, so each process is started anew."""
    for folder in (Path("/tmp"), tmp_path / ("t" * 80)):
        monkeypatch.setattr(tempfile, "tempdir", str(folder))
        method = process_context([]).get_start_method()
        assert method == ("spawn" if len(str(folder)) > 70 else "forkserver")


def test_when_a_given_executor_breaks_this_process_finishes(
    scene: Scene, table: SweepTable
) -> None:
    class Breaking(ThreadPoolExecutor):
        def submit(self, *args: object) -> "Future[JobResult]":  # type: ignore[override]
            future: Future[JobResult] = super().submit(*args)  # type: ignore[arg-type]
            submitted.append(future)
            if len(submitted) < 3:
                return future
            broken: Future[JobResult] = Future()
            broken.set_exception(BrokenProcessPool("A worker was killed."))
            return broken

    submitted: list[Future[JobResult]] = []
    with (
        Breaking(1) as executor,
        pytest.warns(RuntimeWarning, match=r"workers are gone .*; this process finishes it alone"),
    ):
        assert occ.sweep(scene, AXES, 3, BOTH, 7, executor=executor) == table
    assert len(submitted) >= 3


def test_if_an_executor_takes_no_work_this_process_does_it(scene: Scene, table: SweepTable) -> None:
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    with pytest.warns(RuntimeWarning, match="workers are gone"):
        assert occ.sweep(scene, AXES, 3, BOTH, 7, executor=executor) == table


def test_an_error_of_the_model_itself_is_passed_on_from_a_worker(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise ZeroDivisionError("a bug")

    monkeypatch.setattr(sweep, "count_right_and_whole", fail)
    with ThreadPoolExecutor(1) as executor, pytest.raises(ZeroDivisionError, match="a bug"):
        occ.sweep(scene, AXES, executor=executor)


class EnoughError(Exception):
    """The progress callback ends the sweep."""


@pytest.mark.parametrize("kind", [None, ThreadPoolExecutor])
def test_an_exception_from_progress_ends_the_sweep_and_pending_work(
    scene: Scene, kind: type[ThreadPoolExecutor] | None
) -> None:
    futures: list[Future[JobResult]] = []

    class Watched(ThreadPoolExecutor):
        def submit(self, *args: object) -> "Future[JobResult]":  # type: ignore[override]
            futures.append(super().submit(*args))  # type: ignore[arg-type]
            return futures[-1]

    def progress(done: int, *_: object) -> None:
        if done == 3:
            raise EnoughError

    executor = Watched(1) if kind else None
    with pytest.raises(EnoughError):
        occ.sweep(scene, {"iso": range(50, 400)}, 1, executor=executor, progress=progress)
    assert all(future.running() or future.done() for future in futures)
    if executor is not None:
        executor.shutdown(wait=True)
        assert all(future.done() for future in futures)
        assert len(futures) < 20


def test_a_slow_point_reports_progress_from_image_to_image(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    from occ_model.study.sweep import measure as module

    monkeypatch.setattr(module, "REPORT_PERIOD", 0.0)
    told: list[int] = []
    occ.sweep(scene, {"distance": [1.0, 2.0]}, 4, progress=lambda done, *_: told.append(done))
    assert told == [0] * 4 + [1] * 5 + [2]


def refuse_semaphores(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the system behave as if /dev/shm were not writable."""

    def refuse(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(multiprocessing.synchronize.SemLock, "__init__", refuse)


def test_without_processes_the_sweep_runs_here_and_says_so(
    scene: Scene, table: SweepTable, monkeypatch: pytest.MonkeyPatch
) -> None:
    refuse_semaphores(monkeypatch)
    with pytest.warns(RuntimeWarning) as warned:
        assert occ.sweep(scene, AXES, 3, BOTH, 7, jobs=2) == table
    (sentence,) = [str(warning.message) for warning in warned]
    assert sentence.startswith("No processes can be started (")
    assert sentence.endswith("); this one does the sweep alone.")


def test_results_of_a_given_executor_are_not_kept() -> None:
    with ThreadPoolExecutor(1) as executor:
        given = GivenExecutor(executor)
        done = weakref.ref(given.submit(Job(len, ("",)), 0, 1))
    gc.collect()
    assert done() is None
