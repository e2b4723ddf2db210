"""Workers die and jobs fail, but nothing is lost, done twice or blamed on other requests."""

import errno
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Future
from typing import Any, NoReturn

import pytest
from model.parallel.bench import Bench, jobs
from worker_calls import HeldWorker, fail

from occ_model.parallel.job import Job, JobResult, WorkersLostError

MAP, STRIPS = 0, 1


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_a_dead_worker_loses_no_job_and_repeats_no_delivered_one(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, *"abcde"))
    bench.finish(2)
    bench.worker.die()
    bench.settle()
    assert bench.worker.renewed == 1
    bench.finish_all()
    assert bench.results == ["a", "b", "c", "d", "e"]
    assert bench.sent == ["a", "b", "c", "d", "c", "d", "e"]
    assert bench.ended == [(MAP, 1)]
    assert bench.errors == []


def test_a_result_returned_before_its_worker_died_is_kept(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, *"abc"))
    (_, lost), (_, kept) = bench.worker.held
    bench.worker.held.clear()
    # Both happen before the scheduler handles either.
    lost.set_exception(BrokenExecutor("It was killed."))
    kept.set_result(JobResult("b"))
    bench.settle()
    bench.finish_all()
    assert bench.sent == ["a", "b", "a", "c"]
    assert bench.results == ["b", "a", "c"]


def test_jobs_in_flight_are_repeated_in_order_for_each_request(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "m"))
    bench.ask(STRIPS, 1, jobs(1, "s", "t"))
    assert bench.sent == ["m", "s"]
    bench.worker.die()
    bench.settle()
    assert bench.sent[2:] == ["m", "s"]
    assert bench.notices == [("replaced", MAP, 1), ("replaced", STRIPS, 1)]
    bench.finish_all()
    assert bench.results == ["m", "s", "t"]


def test_an_ended_request_is_not_told_of_a_loss(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a"))
    bench.finish_all()
    bench.ask(STRIPS, 1, jobs(0, "s"))
    bench.worker.die()
    bench.settle()
    assert bench.notices == [("replaced", STRIPS, 1)]


def test_a_job_of_an_abandoned_request_is_not_repeated(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a", "b"))
    bench.ask(MAP, 2, jobs(0, "x"))
    bench.worker.die()
    bench.settle()
    assert bench.sent == ["a", "b", "x"]
    bench.finish_all()
    assert bench.results == ["x"]


def test_a_job_refused_by_a_dead_worker_is_sent_again(bench: Bench) -> None:
    class DyingAtSubmit(HeldWorker):
        attempts = 0

        def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
            if len(self.sent) == 1 and not self.renewed:
                self.attempts += 1
                assert self.attempts < 3
                raise self.lost_by[0]("It was killed.")
            return super().submit(job, channel, run)

    bench = Bench(DyingAtSubmit())
    bench.ask(MAP, 1, jobs(0, *"abc"))
    assert bench.sent == ["a", "a", "b"]
    bench.finish_all()
    assert bench.results == ["a", "b", "c"]


def test_workers_that_keep_dying_fail_all_current_requests_but_not_later_ones(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a"))
    bench.ask(STRIPS, 1, jobs(1, "s"))
    for _ in range(3):
        assert bench.errors == []
        bench.worker.die()
        bench.settle()
    assert [(channel, run) for channel, run, _ in bench.errors] == [(MAP, 1), (STRIPS, 1)]
    error = bench.errors[0][2]
    assert isinstance(error, WorkersLostError)
    assert str(error) == "Processes in the background ended 3 times without a result."
    assert error.reason == "BrokenExecutor: It was killed"
    assert bench.worker.renewed == 3
    bench.ask(MAP, 2, jobs(0, "b"))
    bench.finish_all()
    assert bench.results == ["b"]


def test_a_result_in_between_resets_the_count_of_losses(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, *"abcdef"))
    for _ in range(5):
        bench.worker.die()
        bench.settle()
        bench.finish()
    assert bench.errors == []


def test_without_workers_the_request_fails_or_the_fallback_is_used() -> None:
    def start_none() -> NoReturn:
        raise OSError(errno.EROFS, "no semaphores")

    alone = Bench(start=start_none)
    alone.ask(MAP, 1, jobs(0, "a"))
    assert [(run, str(error)) for _, run, error in alone.errors] == [
        (1, "[Errno 30] no semaphores")
    ]
    fallback = HeldWorker()
    helped = Bench(fallback, start=start_none, fallback=lambda: fallback)
    helped.ask(MAP, 1, jobs(0, "a", "b", "c"))
    helped.finish_all()
    assert helped.results == ["a", "b", "c"]
    assert helped.notices == [("missing", MAP, 1)]


def test_without_a_fallback_workers_that_cannot_be_replaced_fail_the_request() -> None:
    class Last(HeldWorker):
        def renew(self) -> None:
            raise NotImplementedError

    alone = Bench(Last())
    alone.ask(MAP, 1, jobs(0, "a"))
    alone.worker.die()
    alone.settle()
    assert isinstance(alone.errors[0][2], WorkersLostError)
    assert alone.sent == ["a"]


def test_a_job_that_raises_fails_only_its_own_request(bench: Bench) -> None:
    bench.ask(MAP, 1, (Job(fail, ("luck",)), *jobs(0, "never", "no")))
    bench.ask(STRIPS, 1, jobs(1, "s", "t"))
    bench.finish_all()
    ((channel, run, error),) = bench.errors
    assert (channel, run, repr(error)) == (MAP, 1, "ValueError('no luck')")
    assert bench.results == ["s", "t"]
    assert bench.ended == [(STRIPS, 1)]
    assert bench.sent == ["luck", "never", "s", "t"]
    assert bench.worker.renewed == 0


def test_after_a_failed_request_the_newer_one_is_done(bench: Bench) -> None:
    bench.ask(MAP, 1, (Job(fail, ("luck",), uninterruptible=True), *jobs(0, "a", whole=True)))
    bench.ask(MAP, 2, jobs(0, "x"))
    bench.finish_all()
    assert [run for _, run, _ in bench.errors] == [1]
    assert bench.results == ["x"]


def test_an_error_of_an_abandoned_request_is_not_reported(bench: Bench) -> None:
    bench.ask(MAP, 1, (Job(fail, ("luck",)),))
    bench.ask(MAP, 2, jobs(0, "x"))
    bench.finish_all()
    assert bench.errors == []
    assert bench.results == ["x"]


def fail_after_one() -> Iterator[Job]:
    yield from jobs(0, "a")
    raise ZeroDivisionError("a mistake")


def test_jobs_that_cannot_be_made_fail_only_their_own_request(bench: Bench) -> None:
    bench.ask_for(MAP, 1, fail_after_one())
    bench.ask(STRIPS, 1, jobs(0, "s"))
    bench.finish_all()
    assert [(run, repr(error)) for _, run, error in bench.errors] == [
        (1, "ZeroDivisionError('a mistake')")
    ]
    assert bench.results == ["s"]


def test_a_job_that_cannot_be_sent_fails_only_its_own_request() -> None:
    class Picky(HeldWorker):
        def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
            if channel == MAP:
                raise TypeError("cannot be sent")
            return super().submit(job, channel, run)

    bench = Bench(Picky())
    bench.ask(MAP, 1, jobs(0, "a"))
    bench.ask(STRIPS, 1, jobs(0, "s"))
    bench.finish_all()
    assert [(run, str(error)) for _, run, error in bench.errors] == [(1, "cannot be sent")]
    assert bench.results == ["s"]


def test_an_unexpected_error_at_the_start_fails_only_the_request() -> None:
    worker, mistakes = HeldWorker(), [ValueError("a mistake")]

    def start() -> Any:
        if mistakes:
            raise mistakes.pop()
        return worker

    bench = Bench(worker, start=start)
    bench.ask(MAP, 1, jobs(0, "a"))
    assert [str(error) for *_, error in bench.errors] == ["a mistake"]
    bench.ask(MAP, 2, jobs(0, "b"))
    bench.finish_all()
    assert bench.results == ["b"]


def test_an_abandoned_result_is_ignored(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a", "b"))
    _, future = bench.worker.held.pop(0)
    future.set_result(JobResult(is_abandoned=True))
    bench.settle()
    bench.finish_all()
    assert bench.reports == [(MAP, 1, ["b"])]
    assert bench.ended == [(MAP, 1)]


def test_ending_cancels_jobs_and_ends_the_workers(bench: Bench) -> None:
    bench.ask(MAP, 4, jobs(0, "a", "b"))
    futures = [future for _, future in bench.worker.held]
    bench.scheduler.close()
    bench.scheduler.run()
    assert all(future.cancelled() for future in futures)
    assert bench.worker.abandoned[-1] == (MAP, 5)
    assert bench.worker.closed == 1


def test_workers_are_started_by_the_first_job(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0))
    assert bench.scheduler.workers is None
    bench.scheduler.close()
    bench.scheduler.run()
    assert bench.worker.closed == 0
