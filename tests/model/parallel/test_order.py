"""Which job is next and when results are reported, with one controlled worker and two channels."""

from collections.abc import Iterator
from typing import Any

import pytest
from model.parallel.bench import Bench, jobs
from worker_calls import echo

from occ_model.parallel.job import Job

MAP, STRIPS = 0, 1


@pytest.fixture
def bench() -> Bench:
    return Bench()


BUSY = (STRIPS, 1, jobs(9, "busy", "busy too"))  # all that the worker takes

# For each law: the requests as channel, number and jobs; the jobs sent; the runs that end.
ORDERS: dict[str, tuple[list[Any], str, list[tuple[int, int]]]] = {
    "the lowest rank first": (
        [BUSY, (MAP, 1, jobs(5, "m", "n")), (STRIPS, 2, jobs(1, "s", "t"))],
        "busy, busy too, s, t, m, n", [(STRIPS, 2), (MAP, 1)],
    ),
    "the lowest rank first, whoever asked": (
        [BUSY, (MAP, 1, jobs(1, "m", "n")), (STRIPS, 2, jobs(5, "s", "t"))],
        "busy, busy too, m, n, s, t", [(MAP, 1), (STRIPS, 2)],
    ),
    "the rank is looked at before each job": (
        [(MAP, 1, jobs(5, *"abcd")), (STRIPS, 1, jobs(1, "x"), jobs(7, "y"))],
        "a, b, x, c, d, y", [(MAP, 1), (STRIPS, 1)],
    ),
    "of equal ranks the request that began first": (
        [(STRIPS, 1, jobs(2, *"stu")), (MAP, 1, jobs(2, *"mn"))],
        "s, t, u, m, n", [(STRIPS, 1), (MAP, 1)],
    ),
    "jobs of a request keep their order, whatever their rank": (
        [(MAP, 1, jobs(8, *"abc"), jobs(1, *"de"))], "a, b, c, d, e", [(MAP, 1)],
    ),
    "uninterruptible jobs are done despite a newer request": (
        [(MAP, 1, jobs(0, *"abc", whole=True), jobs(2, "fine")),
         (MAP, 2, jobs(0, "x", whole=True), jobs(2, "new fine"))],
        "a, b, c, x, new fine", [(MAP, 2)],
    ),
    "uninterruptible jobs that have not been come to are replaced": (
        [(MAP, 1, jobs(0, *"abc"), jobs(0, "d", whole=True)), (MAP, 2, jobs(0, "x"))],
        "a, b, x", [(MAP, 2)],
    ),
    "a newer request replaces an older one before it starts": (
        [BUSY, (MAP, 1, jobs(0, "old")), (MAP, 2, jobs(0, "new"))],
        "busy, busy too, new", [(STRIPS, 1), (MAP, 2)],
    ),
    "behind uninterruptible jobs only the newest is done": (
        [(MAP, 1, jobs(0, *"abc", whole=True)), (MAP, 2, jobs(0, "passed over", whole=True)),
         (MAP, 3, jobs(0, "x", whole=True))],
        "a, b, c, x", [(MAP, 3)],
    ),
    "other channels keep their requests": (
        [(MAP, 1, jobs(0, *"mn")), (STRIPS, 1, jobs(0, "s")), (MAP, 2, jobs(0, "o"))],
        "m, n, s, o", [(STRIPS, 1), (MAP, 2)],
    ),
}  # fmt: skip


@pytest.mark.parametrize("law", ORDERS)
def test_jobs_are_sent_in_order(bench: Bench, law: str) -> None:
    requests, sent, ended = ORDERS[law]
    for request in requests:
        bench.ask(*request)
    bench.finish_all()
    assert (bench.sent, bench.ended) == (sent.split(", "), ended)
    assert bench.results[-1] == bench.sent[-1]


# For each law: the requests, and the jobs sent after a number of them were done.
STEPS: dict[str, tuple[list[Any], dict[int, str]]] = {
    "a job begins while those before it run": (
        [(MAP, 1, jobs(8, "a"), jobs(1, "b"))], {0: "a, b"},
    ),
    "a worker has one job more than it does": (
        [(MAP, 1, jobs(0, *"abcde"))], {0: "a, b", 1: "a, b, c"},
    ),
    "awaited work is not delayed by work that fills a gap": (
        [(MAP, 1, jobs(0, *"ab", whole=True)), (STRIPS, 1, jobs(3, "s"))],
        {1: "a, b", 2: "a, b, s"},
    ),
    "interruptible work lets others fill the gap": (
        [(MAP, 1, jobs(0, *"ab")), (STRIPS, 1, jobs(3, "s"))], {1: "a, b, s"},
    ),
    "a gap is filled by what is as urgent": (
        [(MAP, 1, jobs(2, *"ab", whole=True)), (STRIPS, 1, jobs(2, "s"))], {1: "a, b, s"},
    ),
    "a gap is filled by what is more urgent": (
        [(MAP, 1, jobs(2, *"ab", whole=True)), (STRIPS, 1, jobs(1, "s"))], {1: "a, b, s"},
    ),
    "a later job of the same request does not delay it": (
        [(MAP, 1, jobs(0, "a", whole=True), jobs(2, "fine"))], {0: "a", 1: "a, fine"},
    ),
    "a request waits only for its own channel's jobs": (
        [(MAP, 1, jobs(0, *"abc", whole=True)), (MAP, 2, jobs(0, "x")),
         (STRIPS, 1, jobs(0, "s")), (STRIPS, 2, jobs(0, "t"))],
        {2: "a, b, c, t", 4: "a, b, c, t, x"},
    ),
}  # fmt: skip


@pytest.mark.parametrize("law", STEPS)
def test_the_number_of_jobs_sent_grows_with_the_jobs_done(bench: Bench, law: str) -> None:
    requests, sent = STEPS[law]
    for request in requests:
        bench.ask(*request)
    done = 0
    for count, expected in sent.items():
        bench.finish(count - done)
        assert bench.sent == expected.split(", ")
        done = count


@pytest.mark.parametrize("workers", [1, 3])
def test_jobs_are_made_only_when_they_are_needed(bench: Bench, workers: int) -> None:
    bench.worker.count = workers
    made: list[int] = []

    def make_endless_jobs() -> Iterator[Job]:
        for number in range(1000):
            made.append(number)
            yield Job(echo, (number,))

    bench.ask_for(MAP, 1, make_endless_jobs())
    begun = 2 * workers + 1  # two for each worker are sent, and one waits
    assert len(made) == begun
    bench.finish(10)
    assert len(made) == begun + 10


def test_abandoned_work_does_not_delay_other_work(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "coarse", whole=True))
    bench.ask(STRIPS, 1, jobs(3, "strip"))
    assert bench.sent == ["coarse"]
    bench.scheduler.cancel(MAP, 2)
    bench.settle()
    assert bench.sent == ["coarse", "strip"]


def test_only_uninterruptible_jobs_of_an_old_request_are_continued(bench: Bench) -> None:
    # The jobs that would fill the gap are more urgent, and are held back only as superseded ones.
    bench.ask(MAP, 1, jobs(2, "a", whole=True), jobs(0, "b", "c"))
    assert bench.sent == ["a", "b"]
    bench.ask(MAP, 2, jobs(2, "x"))
    bench.worker.held.reverse()
    bench.finish()
    assert bench.sent == ["a", "b"]
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]


def test_a_newer_request_replaces_a_running_one_at_once(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a", "b", "c"))
    bench.ask(MAP, 2, jobs(0, "x"))
    assert bench.worker.abandoned[-1] == (MAP, 2)
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]
    assert bench.results == ["x"]


def test_cancelling_ends_a_request_and_the_waiting_one(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 2, jobs(0, "x"))
    bench.scheduler.cancel(MAP, 3)
    bench.settle()
    assert bench.worker.abandoned[-1] == (MAP, 3)
    bench.finish_all()
    assert bench.results == []
    assert bench.sent == ["a", "b"]
    bench.ask(MAP, 3, jobs(0, "y"), jobs(0, "z"))
    bench.finish_all()
    assert bench.results == ["y", "z"]
    assert bench.ended == [(MAP, 3)]


def test_a_waiting_request_begins_if_only_the_one_before_is_cancelled(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 2, jobs(0, "x"))
    bench.scheduler.cancel(MAP, 2)
    bench.settle()
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]
    assert bench.results == ["x"]


def test_cancelling_earlier_requests_leaves_the_current_one(bench: Bench) -> None:
    bench.ask(MAP, 2, jobs(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 3, jobs(0, "x"))
    bench.scheduler.cancel(MAP, 2)
    bench.finish_all()
    assert bench.results == ["a", "b", "c", "x"]


def test_a_request_without_jobs_ends_at_once_even_if_workers_are_busy(bench: Bench) -> None:
    bench.ask(*BUSY)
    bench.ask(MAP, 1)
    assert bench.ended == [(MAP, 1)]


def test_the_end_is_reported_once_after_all_results(bench: Bench) -> None:
    bench.ask(MAP, 1, jobs(0, "a", "b"), jobs(1, "c"))
    bench.finish(2)
    assert bench.ended == []
    bench.finish()
    assert bench.results == ["a", "b", "c"]
    assert bench.ended == [(MAP, 1)]


def test_results_of_uninterruptible_jobs_are_reported_together_and_others_at_once(
    bench: Bench,
) -> None:
    bench.ask(MAP, 1, jobs(0, *"abc", whole=True), jobs(0, *"de"))
    bench.finish_all()
    assert [results for *_, results in bench.reports] == [["a", "b", "c"], ["d"], ["e"]]
