"""The pane of accuracy and time: the settings of the simulation, and its measured costs."""

from occ_gui.accuracy.accuracy_view import AccuracyView
from occ_gui.accuracy.controller import AccuracyController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import PiecesPane
from occ_gui.shell.results import of_snapshot
from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import Snapshot


class AccuracyPane(PiecesPane):
    def __init__(self, scenes: SceneStore, simulation: SimulationController) -> None:
        self.view = view = AccuracyView()
        super().__init__(view, view.show_settings, view.show_switched, self._show_snapshot)
        settings = scenes.settings
        self.made_of = dict.fromkeys(view.scene_parts, of_snapshot)
        self.study = AccuracyController(scenes, simulation, view)
        self.measures = (self.study,)
        view.tolerance_edited.connect(settings.set_tolerance)
        view.observable.chosen.connect(settings.set_observable)
        view.noise.chosen.connect(settings.set_noise)
        view.table.switched.connect(scenes.force)
        view.refused.connect(self.status_message)
        view.accepted.connect(self.accepted)
        settings.refused.connect(self._show_refused)
        self._settings = settings

    def _show_snapshot(self, snapshot: Snapshot) -> None:
        self.view.show_snapshot(snapshot)
        self.study.show_snapshot(snapshot)

    def _show_refused(self, _sentence: str) -> None:
        # The control still shows the refused value.
        self.view.show_settings(self._settings.settings)

    def set_seen(self, seen: bool) -> None:
        self.view.set_seen(seen)
        self.study.set_seen(seen)
