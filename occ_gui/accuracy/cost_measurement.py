"""Measurement of what a scene's effects cost and change, and of the ways to simulate it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter

from occ_gui.background.task import Report
from occ_gui.values.simulated import SimulationRequest
from occ_model.effects.plan import plan_with
from occ_model.results.accuracy import AccuracyPoint, EffectDifference, MeasuredCosts, TimeFractions
from occ_model.simulation.render import render_with
from occ_model.simulation.stage_timer import StageTimer
from occ_model.study.accuracy import accuracy, point_count
from occ_model.study.effect_differences import CompleteSimulation

_RUNS, _PATIENCE = 5, 1.0  # most runs of each picture, and seconds after which no more begin


@dataclass(frozen=True, slots=True)
class SceneCosts:
    request: SimulationRequest
    # Times of pictures made in turn: with the plan's effects, with all of the scene's, with none
    pictures: tuple[TimeFractions, ...] = ()
    differences: Mapping[str, EffectDifference] = field(default_factory=dict)
    errors: Mapping[frozenset[str], float] = field(default_factory=dict)

    def find_costs(self, request: SimulationRequest, picture: TimeFractions) -> MeasuredCosts:
        """Return the known costs of a request whose picture took these times.

        Times measured in turn with other pictures replace them, because only those can be compared.
        """
        is_comparable = _comparison_key(request) == _comparison_key(self.request)
        pictures = self.pictures if self.request.scene == request.scene else ()
        same_pictures = (each for each in pictures if each.included == picture.included)
        return MeasuredCosts(
            next(same_pictures, picture),
            pictures,
            self.differences if is_comparable else {},
            self.errors if is_comparable else {},
        )


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
        costs = replace(costs, pictures=_time_in_turn(request, report))
        for effect in complete.effects:
            differences = {**costs.differences, effect: complete.without(effect, timer)}
            costs = replace(costs, differences=differences, errors=complete.errors)
            report(costs)
        total = point_count(request.scene, request.settings)
        for point in accuracy(request.scene, request.settings, complete):
            report(MeasuredPoint(_use_stated_time(point, costs), total))
        report(replace(costs, errors=complete.errors))

    def _simulate(self, request: SimulationRequest, timer: StageTimer) -> CompleteSimulation:
        key = _comparison_key(request)
        if self._complete is None or self._complete[0] != key:
            self._complete = None  # one at a time: its pictures are large
            settings = request.settings
            complete = CompleteSimulation(request.scene, settings.observable, settings.seed, timer)
            self._complete = (key, complete)
        return self._complete[1]


def _comparison_key(request: SimulationRequest) -> tuple[object, ...]:
    return request.scene, request.settings.observable, request.settings.seed


def _time_in_turn(request: SimulationRequest, report: Report) -> tuple[TimeFractions, ...]:
    """Time pictures with the plan's effects, all and none in turn; keep each one's fastest run."""
    settings = request.settings
    exact, bare = (replace(settings, tolerance=value, force={}) for value in (0.0, math.inf))
    runs: dict[frozenset[str], list[TimeFractions]] = {}
    deadline = perf_counter() + _PATIENCE
    for run in range(_RUNS):
        if run and perf_counter() > deadline:
            break
        for variant in (settings, exact, bare):
            report(None)
            fractions = TimeFractions.of(render_with(request.scene, variant))
            runs.setdefault(fractions.included, []).append(fractions)
    return tuple(TimeFractions.of_runs(fractions) for fractions in runs.values())


def _use_stated_time(point: AccuracyPoint, costs: SceneCosts) -> AccuracyPoint:
    """Return a point with the time that the pane states elsewhere for the same picture."""
    stated = (p.seconds for p in costs.pictures if p.included == frozenset(point.effects))
    return point if point.part != "effects" else replace(point, seconds=next(stated, point.seconds))


class _CancellableTimer(StageTimer):
    """A timer that ends cancelled work after each stage, not only after the last."""

    def __init__(self, report: Report) -> None:
        super().__init__()
        self._report = report

    def end_stage(self, stage: str) -> None:
        super().end_stage(stage)
        self._report(None)
