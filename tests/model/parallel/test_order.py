"""Which job goes next and when results are reported, with one held worker and two channels."""

from collections.abc import Iterator

import pytest
from model.parallel.bench import Bench, stage
from worker_calls import echo

from occ_model.parallel.job import Job, Stage

MAP, STRIPS = 0, 1


@pytest.fixture
def bench() -> Bench:
    return Bench()


def occupy(bench: Bench) -> None:
    """Give the worker all that it takes: what is asked for next has to wait."""
    bench.ask(STRIPS, 1, stage(9, "busy", "busy too"))


@pytest.mark.parametrize("ranks", [(5, 1), (1, 5)])
def test_the_lowest_rank_goes_first_whoever_asked_first(
    bench: Bench, ranks: tuple[int, int]
) -> None:
    of_map, of_strips = ranks
    bench.ask(MAP, 1, stage(0, "busy", "busy too"), stage(of_map, of_map, of_map))
    bench.ask(STRIPS, 1, stage(of_strips, of_strips, of_strips))
    bench.finish_all()
    assert bench.sent == ["busy", "busy too", 1, 1, 5, 5]


def test_the_rank_is_looked_at_again_before_each_job(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(5, *"abcd"))
    bench.ask(STRIPS, 1, stage(1, "x"), stage(7, "y"))
    bench.finish_all()
    assert bench.sent == ["a", "b", "x", "c", "d", "y"]


def test_of_equal_ranks_the_request_that_began_first_goes_first(bench: Bench) -> None:
    bench.ask(STRIPS, 1, stage(2, "s1", "s2", "s3"))
    bench.ask(MAP, 1, stage(2, "m1", "m2"))
    bench.finish_all()
    assert bench.sent == ["s1", "s2", "s3", "m1", "m2"]


def test_jobs_of_a_stage_and_stages_of_a_request_keep_order(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(8, "a", "b", "c"), stage(4), stage(1, "d", "e"))
    bench.finish_all()
    assert bench.sent == bench.results == ["a", "b", "c", "d", "e"]


def test_a_stage_begins_while_the_previous_ones_last_jobs_run(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(8, "a"), stage(1, "b"))
    assert bench.sent == ["a", "b"]


def test_a_worker_has_one_job_more_than_it_does(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, *"abcde"))
    assert bench.sent == ["a", "b"]
    bench.finish()
    assert bench.sent == ["a", "b", "c"]


def test_jobs_are_made_only_when_they_are_needed(bench: Bench) -> None:
    made: list[int] = []

    def jobs() -> Iterator[Job]:
        for number in range(1000):
            made.append(number)
            yield Job(echo, (number,))

    bench.ask(MAP, 1, Stage(0, jobs()))
    assert len(made) == 2 + 1  # two in flight, and one that waits
    bench.finish(10)
    assert len(made) == 13


def test_awaited_work_is_not_delayed_by_work_that_fills_a_gap(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "coarse 1", "coarse 2", whole=True))
    bench.ask(STRIPS, 1, stage(3, "strip"))
    bench.finish()
    assert bench.sent == ["coarse 1", "coarse 2"]
    bench.finish()
    assert bench.sent == ["coarse 1", "coarse 2", "strip"]


def test_an_interruptible_stage_lets_others_fill_the_gap(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "fine 1", "fine 2"))
    bench.ask(STRIPS, 1, stage(3, "strip"))
    bench.finish()
    assert bench.sent == ["fine 1", "fine 2", "strip"]


@pytest.mark.parametrize("rank", [2, 1])
def test_a_gap_is_filled_by_what_is_as_urgent_or_more_so(bench: Bench, rank: int) -> None:
    bench.ask(MAP, 1, stage(2, "coarse 1", "coarse 2", whole=True))
    bench.ask(STRIPS, 1, stage(rank, "strip"))
    bench.finish()
    assert bench.sent == ["coarse 1", "coarse 2", "strip"]


def test_a_later_stage_of_the_same_request_does_not_delay_it(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "coarse", whole=True), stage(2, "fine"))
    assert bench.sent == ["coarse"]
    bench.finish()
    assert bench.sent == ["coarse", "fine"]


def test_an_abandoned_stage_delays_nothing(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "coarse", whole=True))
    bench.ask(STRIPS, 1, stage(3, "strip"))
    assert bench.sent == ["coarse"]
    bench.scheduler.cancel(MAP, 2)
    bench.settle()
    assert bench.sent == ["coarse", "strip"]


def test_an_uninterruptible_stage_ends_despite_a_newer_request(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b", "c", whole=True), stage(2, "fine"))
    bench.ask(MAP, 2, stage(0, "x", whole=True), stage(2, "new fine"))
    bench.finish_all()
    assert bench.sent == ["a", "b", "c", "x", "new fine"]
    assert bench.results == ["a", "b", "c", "x", "new fine"]
    assert bench.ended == [(MAP, 2)]


def test_only_an_old_requests_uninterruptible_stage_goes_on(bench: Bench) -> None:
    # The stage that fills the gap is more urgent: only that it is superseded holds it back.
    bench.ask(MAP, 1, stage(2, "a", whole=True), stage(0, "b", "c"))
    assert bench.sent == ["a", "b"]
    bench.ask(MAP, 2, stage(2, "x"))
    bench.worker.held.reverse()
    bench.finish()
    assert bench.sent == ["a", "b"]
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]


def test_an_uninterruptible_stage_that_has_not_begun_is_replaced(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b", "c"), stage(0, "d", whole=True))
    bench.ask(MAP, 2, stage(0, "x"))
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]
    assert bench.ended == [(MAP, 2)]


def test_a_request_waits_only_for_its_own_channels_stages(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 2, stage(0, "x"))
    bench.ask(STRIPS, 1, stage(0, "s"))
    bench.ask(STRIPS, 2, stage(0, "t"))
    bench.finish(2)
    assert bench.sent == ["a", "b", "c", "t"]
    bench.finish_all()
    assert bench.sent == ["a", "b", "c", "t", "x"]


def test_a_newer_request_replaces_an_older_one_before_it_starts(bench: Bench) -> None:
    occupy(bench)
    bench.ask(MAP, 1, stage(0, "old"))
    bench.ask(MAP, 2, stage(0, "new"))
    bench.finish_all()
    assert bench.sent == ["busy", "busy too", "new"]
    assert bench.ended == [(STRIPS, 1), (MAP, 2)]


def test_behind_an_uninterruptible_stage_only_the_newest_is_done(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 2, stage(0, "passed over", whole=True))
    bench.ask(MAP, 3, stage(0, "x", whole=True))
    bench.finish_all()
    assert bench.sent == ["a", "b", "c", "x"]
    assert bench.ended == [(MAP, 3)]


def test_a_newer_request_replaces_a_running_one_at_once(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b", "c"))
    bench.ask(MAP, 2, stage(0, "x"))
    assert bench.worker.abandoned[-1] == (MAP, 2)
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]
    assert bench.results == ["x"]


def test_other_channels_keep_their_requests(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "m1", "m2"))
    bench.ask(STRIPS, 1, stage(0, "s"))
    bench.ask(MAP, 2, stage(0, "n"))
    bench.finish_all()
    assert sorted(bench.results) == ["n", "s"]
    assert sorted(bench.ended) == [(MAP, 2), (STRIPS, 1)]


def test_a_cancelled_request_ends_and_the_one_behind_it_too(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 2, stage(0, "x"))
    bench.scheduler.cancel(MAP, 3)
    bench.settle()
    assert bench.worker.abandoned[-1] == (MAP, 3)
    bench.finish_all()
    assert bench.results == []
    assert bench.sent == ["a", "b"]
    bench.ask(MAP, 3, stage(0, "y"), stage(0, "z"))
    bench.finish_all()
    assert bench.results == ["y", "z"]
    assert bench.ended == [(MAP, 3)]


def test_the_request_behind_one_that_is_cancelled_alone_begins(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 2, stage(0, "x"))
    bench.scheduler.cancel(MAP, 2)
    bench.settle()
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]
    assert bench.results == ["x"]


def test_cancelling_earlier_requests_leaves_the_one_at_work(bench: Bench) -> None:
    bench.ask(MAP, 2, stage(0, "a", "b", "c", whole=True))
    bench.ask(MAP, 3, stage(0, "x"))
    bench.scheduler.cancel(MAP, 2)
    bench.finish_all()
    assert bench.results == ["a", "b", "c", "x"]


def test_a_request_without_jobs_ends_at_once_on_busy_workers(bench: Bench) -> None:
    occupy(bench)
    bench.ask(MAP, 1)
    bench.ask(MAP, 2, stage(0), stage(1, whole=True))
    assert bench.ended == [(MAP, 1), (MAP, 2)]


def test_a_stage_without_jobs_holds_nothing_up(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, whole=True), stage(1, "a", "b", "c"))
    bench.ask(MAP, 2, stage(1, "x"))
    bench.finish_all()
    assert bench.sent == ["a", "b", "x"]


def test_the_end_is_reported_once_after_all_results(bench: Bench) -> None:
    bench.ask(MAP, 1, stage(0, "a", "b"), stage(1, "c"))
    bench.finish(2)
    assert bench.ended == []
    bench.finish()
    assert bench.results == ["a", "b", "c"]
    assert bench.ended == [(MAP, 1)]


def test_without_an_interval_each_result_is_reported_at_once() -> None:
    bench = Bench()
    bench.ask(MAP, 1, stage(0, "a", "b", "c"))
    bench.finish_all()
    assert [results for *_, results in bench.reports] == [["a"], ["b"], ["c"]]


def test_results_within_an_interval_are_reported_together() -> None:
    bench = Bench(interval=1.0)
    bench.ask(MAP, 1, stage(0, *"abcdef"), stage(0, "g"))
    bench.finish()
    bench.time = 0.9
    bench.finish(2)
    bench.time = 1.0
    bench.finish()
    bench.time = 1.5
    bench.finish()
    assert [results for *_, results in bench.reports] == [["a"], ["b", "c", "d"]]


def test_the_end_of_a_stage_is_reported_at_once() -> None:
    bench = Bench(interval=1.0)
    bench.ask(MAP, 1, stage(0, "a", "b", "c"), stage(0, "d", "e"))
    bench.finish(3)
    assert [results for *_, results in bench.reports] == [["a"], ["b", "c"]]
    bench.finish(2)
    assert [results for *_, results in bench.reports] == [["a"], ["b", "c"], ["d", "e"]]
    assert bench.ended == [(MAP, 1)]


def test_each_channel_has_its_own_interval() -> None:
    bench = Bench(interval=1.0)
    bench.ask(MAP, 1, stage(0, "a", "b", "c"))
    bench.ask(STRIPS, 1, stage(1, "s", "t", "u"))
    bench.finish(5)
    assert bench.reports == [(MAP, 1, ["a"]), (MAP, 1, ["b", "c"]), (STRIPS, 1, ["s"])]


def test_an_uninterruptible_stage_has_an_interval_of_its_own() -> None:
    bench = Bench(interval=1.0, stage_interval=3.0)
    bench.ask(MAP, 1, stage(0, *"abcde", whole=True), stage(1, "f", "g", "h"))
    bench.finish()
    bench.time = 2.0
    bench.finish()
    bench.time = 3.0
    bench.finish()
    assert [results for *_, results in bench.reports] == [["a"], ["b", "c"]]
    bench.finish(2)
    bench.time = 4.0
    bench.finish()
    assert [results for *_, results in bench.reports] == [["a"], ["b", "c"], ["d", "e"], ["f"]]
