"""The scene in the window: connects its controls, presets, refusals and results."""

from PySide6.QtCore import QObject

from occ_gui.accuracy.plan_changes import PlanChanges, describe_switches
from occ_gui.app.parts import Parts
from occ_gui.picture.before_controller import BeforeController
from occ_gui.scene.control_panel import main_of
from occ_gui.scene.forced_effects import accuracy_badge, describe_accuracy
from occ_gui.shell.results import entries_of
from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.frame import Decision
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.teaching.marked_values import marked_values


class SceneInWindow(QObject):
    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._parts = parts
        self.before = BeforeController(parts.scene_store.store, parts.results_store.show_before)
        self.plan_changes = PlanChanges(self)
        self._connect_scene()
        self._connect_simulation()
        self._list_presets()
        self._list_recent()
        self._show_scene(parts.scene_store.scene)
        self._show_settings(parts.scene_store.settings.settings)

    def _connect_scene(self) -> None:
        parts, messages = self._parts, self._parts.messages
        controls, editor, scenes = parts.controls, parts.editor, parts.scene_store
        controls.connect_editor(editor)
        controls.preset_chosen.connect(parts.presets.load)
        controls.forced.released.connect(scenes.release_effects)
        editor.edit_started.connect(messages.accept)
        editor.input_refused.connect(messages.note)
        scenes.changed.connect(self._show_scene)
        scenes.store.select(entries_of).changed.connect(messages.accept)
        scenes.refused.connect(self._refuse)
        scenes.noted.connect(messages.note)
        scenes.refused_for.connect(controls.show_problem)
        scenes.settings.changed.connect(self._show_settings)
        scenes.settings.refused.connect(messages.note)
        parts.presets.changed.connect(self._list_presets)
        parts.preferences.changed.connect(self._list_recent)

    def _connect_simulation(self) -> None:
        parts, simulation = self._parts, self._parts.simulation
        self.plan_changes.changed.connect(parts.results_store.show_switched)
        self.plan_changes.changed.connect(self._report_switched)
        # The store of results last, because its panes compare pictures with what the others hold.
        for view in (self.before, parts.pins, self.plan_changes, parts.results_store):
            simulation.snapshot_ready.connect(view.show_snapshot)
        simulation.reading_shown.connect(parts.results_store.show_reading)
        simulation.picture_ready.connect(parts.results_store.show_picture)
        simulation.snapshot_shown.connect(self._on_snapshot)
        simulation.failed_for.connect(parts.messages.say_failure)
        simulation.failed.connect(parts.pins.cancel_waiting)
        simulation.defer_while(self._is_map_awaited)

    def _is_map_awaited(self) -> bool:
        pane = self._parts.shell.find_pane("map")
        return pane is not None and pane.map.awaits_first_points

    def _report_switched(self, switched: tuple[Decision, ...]) -> None:
        self._parts.window.show_plan_change(describe_switches(switched) if switched else "")

    def _on_snapshot(self, snapshot: Snapshot) -> None:
        reading_seconds = snapshot.reading_seconds if snapshot.results else None
        self._parts.window.show_timing(snapshot.simulation_seconds, reading_seconds)

    def _show_scene(self, scene: Scene) -> None:
        parts = self._parts
        parts.controls.show_scene(scene)
        parts.controls.show_preset(*parts.presets.shown_names)
        names = main_of(scene.transmitter.light)
        parts.window.menus.show_animations(names)
        for name in names:  # marks where the picture changes in kind
            parts.controls.show_marks(name, marked_values(scene, name))

    def _show_settings(self, settings: SimulationSettings) -> None:
        parts = self._parts
        labels = parts.scene_store.settings.effect_labels
        parts.controls.forced.show_list(describe_accuracy(settings, labels))
        parts.window.show_accuracy(accuracy_badge(settings, labels))

    def _refuse(self, sentence: str) -> None:
        # The control still shows the refused value.
        self._parts.controls.show_scene(self._parts.scene_store.scene)
        self._parts.messages.note(sentence)

    def _list_presets(self) -> None:
        presets, controls = self._parts.presets, self._parts.controls
        controls.list_presets(presets.titles, presets.unreadable, presets.user_presets)
        controls.show_preset(*presets.shown_names)

    def _list_recent(self) -> None:
        preferences, files = self._parts.preferences, self._parts.files
        menus = self._parts.window.menus
        menus.show_recent(preferences.files, files.open_recent, preferences.clear)
