"""Every moment of a simulation counts to one stage."""

from itertools import chain, repeat

import pytest

import occ_model as occ
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.paper_view import paper_view_of
from occ_model.effects.plan import plan_of
from occ_model.effects.registry import planned
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.simulation import stage_timer
from occ_model.simulation.columns import expose_columns
from occ_model.simulation.noise import Drawn, ExactNoise
from occ_model.simulation.pixels import PixelExposure
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


def test_drawing_noise_counts_to_the_last_kind_of_noise(monkeypatch: pytest.MonkeyPatch) -> None:
    moment = [0.0]
    monkeypatch.setattr(stage_timer, "perf_counter", lambda: moment[0])

    class SlowNoise(ExactNoise):
        def draw(self, rows: int) -> Drawn:
            moment[0] += 1.0
            return super().draw(rows)

    scene = occ.load_preset("phone-136us-real").replace(rows=100, columns=200, gain_variation=0.02)
    view, timer = paper_view_of(scene), StageTimer()
    chosen = plan_of(view, SimulationSettings(tolerance=0.0))
    assert [noise.name for noise in planned(chosen, NoiseEffect)] == [
        "fixed-pattern",
        "sensor-noise",
    ]
    columns = expose_columns(view, chosen, timer)
    exposure = PixelExposure(view, chosen, columns, timer)
    bands = list(exposure._drawn(1, SlowNoise))
    assert bands
    assert all(band.timer.timings == {"sensor-noise": 1.0} for band in bands)


def test_stages_that_took_no_time_share_what_has_passed_alike(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    timer, thread = timer_at(monkeypatch, 0.0), timer_at(monkeypatch, 0.0)
    for stage in ("light", "noise"):
        thread.stage_ended(stage)
    monkeypatch.setattr(stage_timer, "perf_counter", lambda: 6.0)
    timer.parallel_stages_ended([thread])
    assert timer.timings == {"light": 3.0, "noise": 3.0}
