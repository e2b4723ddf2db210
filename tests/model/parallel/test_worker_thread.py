"""Where the system cannot start processes a thread does their work."""

import time
from collections.abc import Iterator

import pytest
from worker_calls import count_for_ever, count_to, echo

from occ_model.parallel.job import Job
from occ_model.parallel.worker_thread import WorkerThread

PATIENCE_S = 10.0


@pytest.fixture
def worker() -> Iterator[WorkerThread]:
    worker = WorkerThread()
    yield worker
    worker.close()


def wait_for_heartbeats(worker: WorkerThread) -> None:
    deadline = time.monotonic() + PATIENCE_S
    counted = worker.counted(3)
    while worker.counted(3) == counted:
        assert time.monotonic() < deadline
        time.sleep(0.001)


def test_jobs_are_done_one_after_the_other(worker: WorkerThread) -> None:
    futures = [worker.submit(Job(echo, (value,)), 0, 1) for value in (1, 2, 3)]
    assert [future.result(PATIENCE_S).value for future in futures] == [1, 2, 3]


def test_an_abandoned_job_ends_at_its_next_heartbeat(worker: WorkerThread) -> None:
    endless = worker.submit(Job(count_for_ever, (), 3), 0, 1)
    wait_for_heartbeats(worker)
    worker.abandon(0, 2)
    assert endless.result(PATIENCE_S).is_abandoned
    assert worker.submit(Job(echo, ("late",)), 0, 1).result(PATIENCE_S).is_abandoned
    assert worker.submit(Job(echo, ("new",)), 0, 2).result(PATIENCE_S).value == "new"


def test_each_counter_holds_the_heartbeats_of_its_jobs_and_no_others(worker: WorkerThread) -> None:
    for counter, number in ((3, 5), (0, 2), (3, 4)):
        assert worker.submit(Job(count_to, (number,), counter), 0, 1).result(PATIENCE_S).value
    # Each job's heart beats once as it begins.
    assert [worker.counted(counter) for counter in range(4)] == [3, 0, 0, 11]


def test_other_channels_go_on(worker: WorkerThread) -> None:
    worker.abandon(1, 7)
    assert worker.submit(Job(echo, ("done",)), 0, 1).result(PATIENCE_S).value == "done"


def test_closing_ends_everything(worker: WorkerThread) -> None:
    endless = worker.submit(Job(count_for_ever, (), 3), 0, 1)
    waiting = worker.submit(Job(echo, ("late",)), 0, 1)
    wait_for_heartbeats(worker)
    worker.close()
    assert endless.result(PATIENCE_S).is_abandoned
    assert waiting.cancelled()
