"""Controller of the accuracy study: it runs while the scene is unchanged and the pane visible."""

from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QObject, QTimer

from occ_gui.background.cancellable import Cancellable, Report
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import SettingsStore
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import SimulationRequest
from occ_model.results import AccuracyPoint
from occ_model.study.accuracy import accuracy, point_count

IDLE_MS = 700
"""Milliseconds without a change after which the study starts."""


class AccuracyPane(Protocol):
    """A pane that shows the points of a study as they are measured."""

    def show_study_begun(self) -> None:
        """Show that a study of the current scene has begun."""

    def show_point(self, point: AccuracyPoint, number: int, total: int) -> None:
        """Add a point, the given number of a total."""

    def show_study_finished(self) -> None:
        """Show that the study is complete."""

    def show_study_outdated(self) -> None:
        """Show that the points belong to an earlier scene, and that no more will be measured."""

    def show_study_failed(self, sentence: str) -> None:
        """Show why the study failed."""


@dataclass(frozen=True, slots=True)
class Measured:
    """One point of a study, and the total number of points."""

    point: AccuracyPoint
    total: int


def measure(request: SimulationRequest, report: Report) -> None:
    """Measure the points of a study and report each.

    Raises
    ------
    ProjectionError
        The scene has no picture.
    """
    total = point_count(request.scene, request.settings)
    for point in accuracy(request.scene, request.settings):
        report(Measured(point, total))


class AccuracyController(QObject):
    """Starts the study when nothing has changed for a while, and cancels it at the next change.

    It never runs during the simulation of a picture: both would be slower, and its times wrong.

    Parameters
    ----------
    scenes, settings
        The scene and the simulation settings that are measured.
    simulation
        The simulation of pictures, which takes precedence.
    pane
        Shows the points; nothing is measured while it is hidden.
    """

    def __init__(
        self,
        scenes: SceneStore,
        settings: SettingsStore,
        simulation: SimulationController,
        pane: AccuracyPane,
    ) -> None:
        super().__init__()
        self._scenes = scenes
        self._settings = settings
        self._simulation = simulation
        self._pane = pane
        self._seen = False
        self._done: SimulationRequest | None = None
        self._count = 0
        self._idle_timer = QTimer(self, singleShot=True)
        self._idle_timer.timeout.connect(self._start)
        self.runner: Cancellable[SimulationRequest, None] = Cancellable(measure, "accuracy study")
        self.runner.reported.connect(self._show)
        self.runner.finished.connect(self._finish)
        self.runner.failed.connect(self._fail)
        for store in (scenes, settings):
            store.changed.connect(self._restart)
        simulation.runner.idle.connect(self._wait_until_idle)

    @property
    def is_idle(self) -> bool:
        """Whether nothing is being measured or about to be."""
        return not (self._idle_timer.isActive() or self.runner.is_running)

    def _request(self) -> SimulationRequest:
        return SimulationRequest(self._scenes.scene, self._settings.settings)

    def set_seen(self, seen: bool) -> None:
        """Measure while the pane is visible, and stop when it is hidden."""
        self._seen = seen
        if seen:
            self._wait_until_idle()
            return
        self._idle_timer.stop()
        if self.runner.is_running:
            self.runner.cancel()
            self._pane.show_study_outdated()

    def _restart(self) -> None:
        self._idle_timer.stop()
        self.runner.cancel()
        self._done = None
        self._pane.show_study_outdated()
        self._wait_until_idle()

    def _wait_until_idle(self) -> None:
        if self._seen and not self.runner.is_running and self._done is None:
            self._idle_timer.start(IDLE_MS)

    def _start(self) -> None:
        if not self._simulation.runner.is_idle:
            return  # it starts again when the simulation is idle
        self._count = 0
        self.runner.start(self._request())
        self._pane.show_study_begun()

    def _show(self, measured: Measured) -> None:
        self._count += 1
        self._pane.show_point(measured.point, self._count, measured.total)

    def _finish(self, _result: object) -> None:
        self._done = self._request()
        self._pane.show_study_finished()

    def _fail(self, sentence: str) -> None:
        self._done = self._request()  # it would fail again
        self._pane.show_study_failed(sentence)

    def stop(self) -> None:
        """Stop measuring."""
        self._idle_timer.stop()
        self.runner.stop()
