"""Every moment of a simulation counts to one stage."""

from itertools import chain, repeat

import pytest

from occ_model.simulation import stage_timer
from occ_model.simulation.stage_timer import StageTimer


def timer_at(monkeypatch: pytest.MonkeyPatch, *moments: float) -> StageTimer:
    clock = chain(moments, repeat(moments[-1]))
    monkeypatch.setattr(stage_timer, "perf_counter", lambda: next(clock))
    return StageTimer()


def test_the_stages_add_up_to_the_time_that_passed(monkeypatch: pytest.MonkeyPatch) -> None:
    timer = timer_at(monkeypatch, 10.0, 11.0, 13.0, 13.5)
    for stage in ("light", "noise", "light"):
        timer.stage_ended(stage)
    assert timer.timings == {"light": 1.5, "noise": 2.0}


def test_stages_of_threads_share_the_time_that_passed(monkeypatch: pytest.MonkeyPatch) -> None:
    timer = timer_at(monkeypatch, 0.0)
    threads = [timer_at(monkeypatch, 0.0, 1.0, 4.0) for _ in range(2)]
    for thread in threads:
        monkeypatch.setattr(stage_timer, "perf_counter", lambda: 1.0)
        thread.stage_ended("light")
        monkeypatch.setattr(stage_timer, "perf_counter", lambda: 4.0)
        thread.stage_ended("noise")
    monkeypatch.setattr(stage_timer, "perf_counter", lambda: 6.0)
    timer.parallel_stages_ended(threads)
    assert timer.timings == pytest.approx({"light": 1.5, "noise": 4.5})
    assert sum(timer.timings.values()) == pytest.approx(6.0)
