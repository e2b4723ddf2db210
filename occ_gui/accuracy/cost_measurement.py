"""Measurement of what a scene's effects cost and change, and of the ways to simulate it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter

from occ_gui.background.task import Report
from occ_gui.simulation.jobs import time_move
from occ_gui.values.simulated import SimulationRequest
from occ_model.effects.plan import plan_with
from occ_model.errors import OccError
from occ_model.results.accuracy import AccuracyPoint, EffectDifference
from occ_model.simulation.stage_timer import StageTimer
from occ_model.study.accuracy import accuracy, move, point_count
from occ_model.study.effect_differences import CompleteSimulation

_MOVED = (
    "switching_frequency",
    "distance",
    "exposure_time",
    "iso",
    "f_number",
    "readout_time",
)  # the sliders whose moves are timed
_LEAST_MOVES, _PATIENCE = 3, 1.0  # fewest moves, and seconds after which no more begin


@dataclass(frozen=True, slots=True)
class SceneCosts:
    """What omitting effects changes in a scene: of each effect, and of sets of effects."""

    request: SimulationRequest
    differences: Mapping[str, EffectDifference] = field(default_factory=dict)
    errors: Mapping[frozenset[str], float] = field(default_factory=dict)

    def is_of(self, request: SimulationRequest) -> bool:
        return _make_key(request) == _make_key(self.request)


@dataclass(frozen=True, slots=True)
class MeasuredPoint:
    """One point of a study, and the total number of points."""

    point: AccuracyPoint
    total: int


class CostMeasurement:
    """Measures on the study's thread; comparisons for the last scene are reused."""

    def __init__(self) -> None:
        self._complete: tuple[object, CompleteSimulation] | None = None

    def __call__(self, request: SimulationRequest, report: Report) -> None:
        timer = _CancellableTimer(report)
        complete = self._simulate(request, timer)
        plan = plan_with(request.scene, request.settings)
        for effects in (plan.included, ()):
            complete.error_of(effects, timer)
        costs = SceneCosts(request, errors=complete.errors)
        report(costs)
        _time_moves(request, report)
        for effect in complete.effects:
            differences = {**costs.differences, effect: complete.without(effect, timer)}
            costs = replace(costs, differences=differences, errors=complete.errors)
            report(costs)
        total = point_count(request.scene, request.settings)
        for point in accuracy(request.scene, request.settings, complete):
            report(MeasuredPoint(point, total))
        report(replace(costs, errors=complete.errors))

    def _simulate(self, request: SimulationRequest, timer: StageTimer) -> CompleteSimulation:
        key = _make_key(request)
        if self._complete is None or self._complete[0] != key:
            self._complete = None  # one at a time: its pictures are large
            settings = request.settings
            complete = CompleteSimulation(request.scene, settings.observable, settings.seed, timer)
            self._complete = (key, complete)
        return self._complete[1]


def _make_key(request: SimulationRequest) -> tuple[object, ...]:
    return request.scene, request.settings.observable, request.settings.seed


def _time_moves(request: SimulationRequest, report: Report) -> None:
    """Time slightly changed scenes, as after moves of each slider, with three plans in turn.

    The plans are the present one, that with all effects and that with none. The same scene again
    would be faster than a move, because parts of it are remembered.
    """
    settings = request.settings
    exact, bare = (replace(settings, tolerance=value, force={}) for value in (0.0, math.inf))
    deadline = perf_counter() + _PATIENCE
    for count, name in enumerate(_MOVED):
        if count >= _LEAST_MOVES and perf_counter() > deadline:
            return
        timed: set[frozenset[str]] = set()
        for place, variant in enumerate((settings, exact, bare), 1):
            try:  # another place for each plan: the first would prepare what others need
                scene = move(request.scene, name, place)
            except OccError:  # the slider is at its end
                continue
            included = frozenset(plan_with(scene, variant).included)
            if included not in timed:
                timed.add(included)
                report(None)
                moved = replace(request, scene=scene, settings=variant)
                report(time_move(moved, with_draft=variant is settings))


class _CancellableTimer(StageTimer):
    """A timer that ends cancelled work after each stage, not only after the last."""

    def __init__(self, report: Report) -> None:
        super().__init__()
        self._report = report

    def end_stage(self, stage: str) -> None:
        super().end_stage(stage)
        self._report(None)
