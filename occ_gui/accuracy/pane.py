"""The pane of accuracy and time: its settings, and the study that runs while it is visible."""

from dataclasses import replace
from typing import TypeAlias

from PySide6.QtCore import QObject, QTimer

from occ_gui.accuracy.accuracy_view import AccuracyView
from occ_gui.accuracy.cost_measurement import CostMeasurement, MeasuredPoint, SceneCosts
from occ_gui.background.task import Task
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import PiecesPane
from occ_gui.shell.results import of_snapshot
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.moves import MoveTime
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.simulated import SimulationRequest
from occ_model.results.accuracy import AccuracyPoint, Forecast, MeasuredCosts
from occ_model.study.effect_differences import forecast

IDLE_MS = 700  # milliseconds without a change after which the study starts

_Question: TypeAlias = tuple[SimulationRequest, MeasuredCosts]
"""A simulation whose time and error are to be predicted from measured costs."""


def _predict(question: _Question, _report: object) -> tuple[SimulationRequest, Forecast]:
    request, costs = question
    return request, forecast(request.scene, request.settings, costs)


class AccuracyController(QObject):
    """Starts the study when nothing has changed for a while, and cancels it at the next change.

    It never runs during the simulation of a picture: both would be slower, and its times wrong. The
    time of the next picture is predicted at every change.
    """

    def __init__(
        self, scenes: SceneStore, simulation: SimulationController, view: AccuracyView
    ) -> None:
        super().__init__()
        self._scenes, self._simulation, self._view = scenes, simulation, view
        self._is_visible = False
        self._finished_request: SimulationRequest | None = None
        self._count = 0
        self._costs: SceneCosts | None = None
        self._snapshot: Snapshot | None = None
        self._idle_timer = QTimer(self, singleShot=True)
        self._idle_timer.timeout.connect(self._start)
        self.task: Task[SimulationRequest, None] = Task(
            CostMeasurement(), "accuracy study", impatient=True
        )
        self.task.reported.connect(self._show)
        self.task.finished.connect(self._finish)
        self.task.failed.connect(self._fail)
        self.forecasts: Task[_Question, tuple[SimulationRequest, Forecast]] = Task(
            _predict, "forecast of costs"
        )
        self.forecasts.finished.connect(lambda answer: view.show_forecast(*answer))
        for store in (scenes, scenes.settings):
            store.changed.connect(self._restart)
        simulation.task.idle.connect(self._wait_until_idle)

    @property
    def is_idle(self) -> bool:
        is_busy = self._idle_timer.isActive() or not self.task.is_idle
        return not is_busy and self.forecasts.is_idle

    def _request(self) -> SimulationRequest:
        return SimulationRequest(self._scenes.seen, self._scenes.settings.settings)

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        if visible:
            self._predict()
            self._wait_until_idle()
            return
        self._idle_timer.stop()
        if not self.task.is_idle:
            self.task.cancel()
            self._view.plot.show_study_outdated()

    def _restart(self) -> None:
        self._idle_timer.stop()
        self.task.cancel()
        self._finished_request = None
        self._view.plot.show_study_outdated()
        self._predict()
        self._wait_until_idle()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Predict from the times of this picture from now on."""
        self._snapshot = snapshot
        self._predict()

    def _predict(self) -> None:
        """Predict from the last picture if it shows the present scene."""
        snapshot, request = self._snapshot, self._request()
        if not self._is_visible or snapshot is None or snapshot.request.scene != request.scene:
            return
        costs, measured = self._simulation.moves.costs_of(snapshot.frame), self._costs
        if measured is not None and measured.is_of(request):
            costs = replace(costs, differences=measured.differences, errors=measured.errors)
        self._view.show_costs(request, costs)
        self.forecasts.ask((request, costs))

    def _wait_until_idle(self) -> None:
        if self._is_visible and self.task.is_idle and self._finished_request is None:
            self._idle_timer.start(IDLE_MS)

    def _start(self) -> None:
        if not self._simulation.task.is_idle:
            return  # it starts again when the simulation is idle
        self._count = 0
        self.task.ask(self._request())
        self._view.plot.show_study_begun()

    def _show(self, report: SceneCosts | list[MoveTime] | MeasuredPoint) -> None:
        if isinstance(report, MeasuredPoint):
            self._count += 1
            self._view.plot.show_point(
                self._use_stated_time(report.point), self._count, report.total
            )
            return
        if isinstance(report, SceneCosts):
            self._costs = report
        else:
            for time in report:
                self._simulation.moves.add(time)
        self._predict()

    def _use_stated_time(self, point: AccuracyPoint) -> AccuracyPoint:
        """Return a point with the time that the pane states elsewhere for the same effects."""
        if point.part != "effects" or self._snapshot is None:
            return point
        times = self._simulation.moves.costs_of(self._snapshot.frame).times_with(point.effects)
        return point if times is None else replace(point, seconds=times.median)

    def _finish(self, _result: object) -> None:
        self._finished_request = self._request()
        self._view.plot.show_study_finished()

    def _fail(self, sentence: str) -> None:
        self._finished_request = self._request()  # it would fail again
        self._view.plot.show_study_failed(sentence)

    def stop(self) -> None:
        self._idle_timer.stop()
        self.task.stop()
        self.forecasts.stop()


class AccuracyPane(PiecesPane):
    def __init__(self, scenes: SceneStore, simulation: SimulationController) -> None:
        self.view = view = AccuracyView()
        super().__init__(
            view, view.show_settings, view.offer_decision, view.mark_switched, self._show_snapshot
        )
        settings = scenes.settings
        self.made_of = dict.fromkeys(view.scene_parts, of_snapshot)
        self.study = AccuracyController(scenes, simulation, view)
        self.measures = (self.study,)
        view.tolerance_edited.connect(settings.set_tolerance)
        view.observable.chosen.connect(settings.set_observable)
        view.table.switched.connect(scenes.force)
        view.refused.connect(self.status_message)
        view.accepted.connect(self.accepted)
        settings.refused.connect(self._show_refused)
        self._settings = settings

    def _show_snapshot(self, snapshot: Snapshot) -> None:
        self.study.show_snapshot(snapshot)
        self.view.show_snapshot(snapshot)

    def _show_refused(self, _sentence: str) -> None:
        # The control still shows the refused value.
        self.view.show_settings(self._settings.settings)

    def set_visible(self, visible: bool) -> None:
        self.study.set_visible(visible)
