"""Worker processes do jobs, count heartbeats, are replaced when they die, and all end."""

import errno
import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from types import FrameType
from typing import NoReturn

import pytest
from model.parallel.bench import Bench
from worker_calls import (
    PATIENCE_S,
    count_for_ever,
    count_to,
    echo,
    fail,
    process_id,
    wait_until,
)

from occ_model.parallel.job import CHANNELS, Job, JobResult, Workers, WorkerThread
from occ_model.parallel.process_pool import ProcessPool, delay_interrupts


@pytest.fixture
def pool() -> Iterator[ProcessPool]:
    pool = ProcessPool(2, "worker_calls")
    yield pool
    pool.close()


def run_until(bench: Bench, happened: Callable[[], bool]) -> None:
    wait_until(lambda: bench.scheduler.step(0.05) and happened())


def result(future: "Future[JobResult]") -> JobResult:
    return future.result(PATIENCE_S)


def test_an_error_keeps_the_traceback_of_its_process(pool: ProcessPool) -> None:
    error = result(pool.submit(Job(fail, ("luck",)), 0, 1)).error
    assert repr(error) == "ValueError('no luck')"
    assert "in fail" in "".join(error.__notes__)


@pytest.fixture(
    params=[lambda: ProcessPool(2, "worker_calls"), WorkerThread], ids=["pool", "thread"]
)
def workers(request: pytest.FixtureRequest) -> Iterator[Workers]:
    """Provide processes, or the thread that replaces them if the system cannot start any."""
    workers = request.param()
    yield workers
    workers.close()


def test_an_abandoned_job_ends_at_its_next_heartbeat(workers: Workers) -> None:
    endless = workers.submit(Job(count_for_ever, (), 3), 1, 1)
    wait_until(lambda: workers.count_heartbeats(3) > 0)
    assert workers.count_heartbeats(2) == 0
    workers.abandon(0, 2)
    assert not endless.done()
    workers.abandon(1, 2)
    assert result(endless).is_abandoned
    assert result(workers.submit(Job(echo, ("late",)), 1, 1)).is_abandoned
    assert result(workers.submit(Job(echo, ("new",)), 1, 2)).value == "new"
    assert result(workers.submit(Job(echo, ("other",)), 2, 1)).value == "other"


def test_each_counter_counts_the_heartbeats_of_its_own_jobs(workers: Workers) -> None:
    """Each job begins with a heartbeat, so that even a very short one is counted."""
    for counter, numbers in ((5, (3, 4)), (0, (7,)), (CHANNELS - 1, (0,))):
        for number in numbers:
            assert result(workers.submit(Job(count_to, (number,), counter), 0, 1)).value == number
    counted = {counter: workers.count_heartbeats(counter) for counter in range(CHANNELS)}
    assert counted == {**dict.fromkeys(range(CHANNELS), 0), 5: 9, 0: 8, CHANNELS - 1: 1}


def test_closing_a_thread_abandons_its_current_and_waiting_jobs() -> None:
    thread = WorkerThread()
    endless, waiting = (
        thread.submit(Job(*each), 0, 1) for each in ((count_for_ever, (), 3), (echo, ("late",)))
    )
    wait_until(lambda: thread.count_heartbeats(3) > 0)
    thread.close()
    assert result(endless).is_abandoned
    assert waiting.cancelled()


def test_closing_ends_processes_in_the_middle_of_a_job(pool: ProcessPool) -> None:
    for counter in (3, 4):
        pool.submit(Job(count_for_ever, (), counter), 0, 1)
    wait_until(lambda: pool.count_heartbeats(3) > 0 and pool.count_heartbeats(4) > 0)
    processes = pool.processes
    assert len(processes) == 2
    pool.close()
    for number in processes:
        with pytest.raises(ProcessLookupError):
            os.kill(number, 0)


def test_a_killed_process_is_replaced_and_its_jobs_repeated(pool: ProcessPool) -> None:
    bench = Bench(pool)
    bench.ask(0, 1, 12 * (Job(process_id, ()),))
    run_until(bench, lambda: bool(bench.results))
    before = pool.processes
    os.kill(bench.results[0], signal.SIGKILL)
    run_until(bench, lambda: bool(bench.ended))
    assert bench.notices == [("replaced", 0, 1)]
    assert len(bench.results) == 12
    assert set(bench.results) <= {*before, *pool.processes}
    assert set(bench.results) & set(pool.processes)


def test_a_thread_takes_over_if_processes_cannot_be_replaced(
    pool: ProcessPool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_processes() -> NoReturn:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(pool, "start", no_processes)
    bench = Bench(pool, fallback=WorkerThread)
    bench.ask(0, 1, 12 * (Job(process_id, ()),))
    run_until(bench, lambda: bool(bench.results))
    os.kill(bench.results[0], signal.SIGKILL)
    run_until(bench, lambda: bool(bench.ended))
    bench.scheduler.end_workers()
    assert bench.notices == [("missing", 0, 1)]
    assert bench.results[-1] == os.getpid()
    assert len(bench.results) == 12


def test_arguments_that_cannot_be_sent_fail_only_their_request(pool: ProcessPool) -> None:
    bench = Bench(pool)
    bench.ask(0, 1, (Job(echo, (lambda: None,)),))
    bench.ask(1, 1, (Job(echo, ("sent",)),))
    run_until(bench, lambda: bool(bench.errors and bench.ended))
    assert [(channel, run) for channel, run, _ in bench.errors] == [(0, 1)]
    assert bench.results == ["sent"]
    assert bench.notices == []


def test_ctrl_c_is_handled_at_the_end() -> None:
    answered: list[int] = []

    def answer(number: int, _frame: FrameType | None) -> None:
        answered.append(number)

    before = signal.signal(signal.SIGINT, answer)
    try:
        with delay_interrupts():
            signal.raise_signal(signal.SIGINT)
            assert answered == []
        assert answered == [signal.SIGINT]
        assert signal.getsignal(signal.SIGINT) is answer
        with delay_interrupts():
            pass
        assert answered == [signal.SIGINT]
    finally:
        signal.signal(signal.SIGINT, before)


def test_another_thread_does_not_delay_ctrl_c() -> None:
    """Only the main thread may set signal handlers."""
    before = signal.getsignal(signal.SIGINT)
    seen: list[object] = []

    def hold() -> None:
        with delay_interrupts():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=hold)
    thread.start()
    thread.join()
    assert seen == [before]


def test_idle_workers_end_by_themselves_and_are_not_killed(
    pool: ProcessPool, monkeypatch: pytest.MonkeyPatch
) -> None:
    # However long it takes on a busy machine.
    monkeypatch.setattr("occ_model.parallel.process_pool.EXIT_SECONDS", 60.0)
    assert result(pool.submit(Job(echo, ("done",)), 0, 1)).value == "done"
    started = pool.started_processes()
    pool.close()
    assert started
    assert {process.exitcode for process in started} == {0}
