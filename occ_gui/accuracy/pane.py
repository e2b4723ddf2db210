"""The pane of accuracy and time: the settings of the simulation, and what is measured of it."""

from typing import TypeAlias

from occ_gui.accuracy.accuracy_view import AccuracyView
from occ_gui.accuracy.controller import AccuracyController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import of_snapshot
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.plan import Decision
from occ_model.scene.simulation_settings import SimulationSettings

AccuracyPart: TypeAlias = tuple[SimulationSettings, tuple[Decision, ...], Snapshot | None]
"""The settings, the effects that the plan has just switched, and the exact results."""


class AccuracyPane(Pane[AccuracyPart]):
    """Connects the view with the settings and with the study."""

    def __init__(self, scenes: SceneStore, simulation: SimulationController) -> None:
        self.view = view = AccuracyView()
        super().__init__(view)
        settings = scenes.settings
        self.made_of = dict.fromkeys(view.of_scene, of_snapshot)
        self.study = AccuracyController(scenes, simulation, view)
        self.measures = (self.study,)
        self._snapshot: Snapshot | None = None
        view.tolerance_edited.connect(settings.set_tolerance)
        view.observable.chosen.connect(settings.set_observable)
        view.noise.chosen.connect(settings.set_noise)
        view.table.switched.connect(scenes.force)
        settings.refused.connect(self._show_refused)
        self._settings = settings

    def show_part(self, part: AccuracyPart) -> None:
        settings, switched, snapshot = part
        self.view.show_settings(settings)
        self.view.show_switched(switched)
        if snapshot is not None and snapshot is not self._snapshot:
            self._snapshot = snapshot
            self.view.show_snapshot(snapshot)
            self.study.show_snapshot(snapshot)

    def _show_refused(self, _sentence: str) -> None:
        # The control still shows the refused value.
        self.view.show_settings(self._settings.settings)

    def set_seen(self, seen: bool) -> None:
        self.view.set_seen(seen)
        self.study.set_seen(seen)
