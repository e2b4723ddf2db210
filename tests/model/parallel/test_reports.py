"""When results are reported: not more often than they can be shown, and none too late."""

from model.parallel.bench import Bench, stage

MAP, STRIPS = 0, 1


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
