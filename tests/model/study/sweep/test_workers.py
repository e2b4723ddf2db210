"""Laws of a sweep's workers: whoever measures, dies or cannot be started, the table is the same."""

import errno
import math
import multiprocessing
import multiprocessing.synchronize
import os
import signal
import subprocess
import sys
import tracemalloc
from collections.abc import Callable
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

import occ_model as occ
from occ_model.parallel.job import Job, JobResult
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import RateSettings, SweepPoint
from occ_model.scene.scene import Scene
from occ_model.study.sweep import points
from occ_model.study.sweep.points import MeasuredPoints
from occ_model.study.sweep.request_check import checked_request
from occ_model.study.sweep.sweep import work_of
from occ_model.study.sweep.workers import measure_anywhere

BOTH = ("threshold", "matched")
AXES = {"switching_frequency": [3e3, 14.65e3, 15e3, 25e3], "distance": [0.6, 1.4, 1.9]}


@pytest.fixture(scope="module")
def scene() -> Scene:
    return occ.load_preset("phone-136us")


@pytest.fixture(scope="module")
def table(scene: Scene) -> SweepTable:
    """The sweep in this process, which all others must give again."""
    return occ.sweep(scene, AXES, 3, BOTH, 7)


@pytest.mark.parametrize(
    "workers",
    [
        {"jobs": 2},
        pytest.param({"executor": ProcessPoolExecutor}, marks=pytest.mark.whole),
        {"executor": ThreadPoolExecutor},
    ],
)
def test_other_workers_give_the_same_table(
    scene: Scene, table: SweepTable, workers: dict[str, Callable[[int], Executor] | int]
) -> None:
    told: list[tuple[int, int]] = []

    def progress(done: int, total: int, left: float) -> None:
        told.append((done, total))
        assert math.isnan(left) if done == 0 else left >= 0.0

    kind = workers.get("executor")
    if kind is None:
        assert occ.sweep(scene, AXES, 3, BOTH, 7, jobs=2, progress=progress) == table
    else:
        context = {"mp_context": multiprocessing.get_context("spawn")}
        extra = context if kind is ProcessPoolExecutor else {}
        with kind(2, **extra) as executor:  # type: ignore[operator]
            assert occ.sweep(scene, AXES, 3, BOTH, 7, executor=executor, progress=progress) == table
    assert [done for done, _ in told if done] == sorted(done for done, _ in told if done)
    assert told[-1] == (12, 12)


DASK = """
import os, signal, sys

def main():
    from distributed import Client, LocalCluster
    import occ_model as occ

    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
        as cluster,
        Client(cluster) as client,
    ):
        workers = list(client.run(os.getpid).values())

        def kill_one(done, total, left):
            if done and len(workers) == 2:
                os.kill(workers.pop(), signal.SIGKILL)

        for progress in (None, kill_one):
            table = occ.sweep(
                occ.load_preset("phone-136us"), AXES, 3, ("threshold", "matched"), 7,
                executor=client.get_executor(), progress=progress,
            )
            sys.stdout.writelines(table.csv())
        assert len(workers) == 1

if __name__ == "__main__":
    main()
"""


@pytest.mark.whole
def test_a_cluster_gives_the_same_table_also_where_a_worker_dies(
    tmp_path: Path, table: SweepTable
) -> None:
    # In a process of its own: its workers import the main program, and it warns of what it likes.
    program = tmp_path / "cluster.py"
    program.write_text(DASK.replace("AXES", repr(AXES)))
    done = subprocess.run(
        [sys.executable, program], capture_output=True, text=True, timeout=90, check=True
    )
    assert done.stdout == 2 * "".join(table.csv())


def kill_once(killed: list[int]) -> Callable[[int, int, float], None]:
    """Make a progress that kills one worker after the first point."""

    def progress(done: int, _total: int, _left: float) -> None:
        if done and not killed:
            worker = multiprocessing.active_children()[0]
            assert worker.pid is not None
            os.kill(worker.pid, signal.SIGKILL)
            killed.append(worker.pid)

    return progress


def test_a_killed_worker_of_its_own_is_replaced(scene: Scene, table: SweepTable) -> None:
    killed: list[int] = []
    found = occ.sweep(scene, AXES, 3, BOTH, 7, jobs=2, progress=kill_once(killed))
    assert len(killed) == 1
    assert found == table


def test_when_a_given_executor_breaks_this_process_finishes(
    scene: Scene, table: SweepTable
) -> None:
    killed: list[int] = []
    spawn = multiprocessing.get_context("spawn")
    with (
        ProcessPoolExecutor(1, spawn) as executor,
        pytest.warns(RuntimeWarning, match=r"workers are gone .*; this process finishes it alone"),
    ):
        found = occ.sweep(scene, AXES, 3, BOTH, 7, executor=executor, progress=kill_once(killed))
    assert len(killed) == 1
    assert found == table


def test_when_an_executor_takes_no_work_this_process_does_it(
    scene: Scene, table: SweepTable
) -> None:
    executor = ThreadPoolExecutor(1)
    executor.shutdown()
    with pytest.warns(RuntimeWarning, match="workers are gone"):
        assert occ.sweep(scene, AXES, 3, BOTH, 7, executor=executor) == table


def test_an_error_of_the_model_itself_is_passed_on_from_a_worker(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise ZeroDivisionError("a bug")

    monkeypatch.setattr(points, "right_and_whole", fail)
    with ThreadPoolExecutor(1) as executor, pytest.raises(ZeroDivisionError, match="a bug"):
        occ.sweep(scene, AXES, executor=executor)


class EnoughError(Exception):
    """Whoever watches has seen enough."""


@pytest.mark.parametrize("kind", [None, ThreadPoolExecutor])
def test_what_progress_raises_ends_the_sweep_and_pending_work(
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


def test_a_slow_point_gives_signs_of_life_from_image_to_image(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    from occ_model.study.sweep import sweep as module

    monkeypatch.setattr(module, "_BEAT", 0.0)
    told: list[int] = []
    occ.sweep(scene, {"distance": [1.0, 2.0]}, 4, progress=lambda done, *_: told.append(done))
    assert told == [0] * 4 + [1] * 5 + [2]


@pytest.mark.whole
def test_a_sweep_of_200000_points_takes_the_memory_of_a_few(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    axes = {"iso": range(50, 550), "distance": np.linspace(1.0, 2.0, 400)}
    request = checked_request(scene, axes, RateSettings(1, ("threshold",)))
    assert request.points == 200_000
    waiting: list[Future[JobResult]] = []
    most = 0

    class Immediate(Executor):
        _max_workers = 3

        def submit(self, _work: object, job: Job) -> "Future[JobResult]":  # type: ignore[override]
            nonlocal most
            future: Future[JobResult] = Future()
            waiting.append(future)
            most = max(most, len(waiting))
            points = tuple(SweepPoint(index, 10, (10,), "", (1,)) for index, _ in job.arguments[2])
            future.set_result(JobResult(MeasuredPoints(points, 1, 0.001 * len(points))))
            return future

    tracemalloc.start()
    try:
        order = request.in_order_of_work()
        points = measure_anywhere(work_of(request), order, Immediate(), 1, lambda: None)
        for _ in islice(points, 40_000):
            waiting.clear()
        points.close()
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert 1 < most <= 2 * 3 + 1  # in flight, and one whose points are taken
    assert peak < 1_000_000  # 25 bytes a point


PROGRAM = f"""
import sys
import occ_model as occ

if __name__ == "__main__":
    table = occ.sweep(occ.load_preset("phone-136us"), {AXES!r}, 3, {BOTH!r}, 7, jobs=2)
    sys.stdout.writelines(table.csv())
"""


@pytest.mark.whole
def test_a_long_path_of_the_temporary_folder_costs_no_workers(
    tmp_path: Path, table: SweepTable
) -> None:
    # A socket's path has at most 107 bytes, and a folder's name alone may have 255.
    folder = tmp_path / ("t" * 150)
    folder.mkdir()
    program = tmp_path / "sweep.py"
    program.write_text(PROGRAM, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "error", program],
        env={**os.environ, "TMPDIR": str(folder)},
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout == "".join(table.csv())


def refuse_semaphores(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the system behave as where /dev/shm cannot be written to."""

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


def test_without_new_workers_this_process_does_the_rest(
    scene: Scene, table: SweepTable, monkeypatch: pytest.MonkeyPatch
) -> None:
    killed: list[int] = []

    def kill_once(done: int, _total: int, _left: float) -> None:
        if done and not killed:
            refuse_semaphores(monkeypatch)
            for worker in multiprocessing.active_children():
                worker.kill()
                killed.append(worker.pid or 0)

    with pytest.warns(RuntimeWarning, match=r"workers are gone .*; this process finishes it alone"):
        assert occ.sweep(scene, AXES, 3, BOTH, 7, jobs=2, progress=kill_once) == table
    assert killed
