"""Scene store: edits of the scene and its simulation settings, as steps to undo."""

from collections.abc import Mapping
from dataclasses import replace
from itertools import count

from PySide6.QtCore import QElapsedTimer, QObject, Signal

from occ_gui.core.store import NO_GESTURE, Store
from occ_gui.core.workspace import FIRST_SETTINGS, Workspace
from occ_gui.scene.forced_effects import switch_text
from occ_model.errors import OccError, ParameterError
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.refusal import refusal_of
from occ_model.scene.scene import (
    TOLERANCE,
    Observable,
    Scene,
    SimulationSettings,
)


class SettingsStore(QObject):
    """The simulation settings of a workspace, and their edits.

    ``effect_labels`` maps effects to their names on the screen.
    """

    changed = Signal(object)

    refused = Signal(str)  # the reason why a change was not made; the settings are unchanged

    def __init__(self, store: Store, effect_labels: Mapping[str, str] | None = None) -> None:
        super().__init__()
        self.effect_labels = effect_labels or {}
        self._store = store
        store.select(lambda workspace: workspace.settings).changed.connect(self.changed)

    @property
    def settings(self) -> SimulationSettings:
        return self._store.workspace.settings

    def set_tolerance(self, tolerance: float) -> None:
        try:
            self._put(replace(self.settings, tolerance=TOLERANCE.check(tolerance)))
        except OccError as error:
            self.refused.emit(refusal_of(error))

    def set_observable(self, observable: Observable) -> None:
        self._put(replace(self.settings, observable=observable))

    def _put(self, settings: SimulationSettings) -> None:
        self._store.put(replace(self._store.workspace, settings=settings))


_MOST_PARAMETERS_OF_EDIT = 2
"""Most parameters that one edit changes: the exposure time and the ISO speed that follows it."""


class SceneStore(QObject):
    changed = Signal(object)

    refused = Signal(str)  # the reason why a change was not made; the scene is unchanged

    refused_for = Signal(str, object)  # the refusal, and the names of the refused parameters

    noted = Signal(str)  # what else has changed with the scene

    def __init__(self, store: Store, effect_labels: Mapping[str, str] | None = None) -> None:
        super().__init__()
        self.store = store
        self.settings = SettingsStore(store, effect_labels)
        self.undo_stack = store.undo_stack
        store.select(lambda workspace: workspace.scene).changed.connect(self.changed)

    @property
    def scene(self) -> Scene:
        return self.store.workspace.scene

    @property
    def seen(self) -> Scene:
        """The scene of one picture; with a colour camera, the scene of the shown colour.

        If a colour camera's values do not go together, it is the scene itself, which is refused.
        """
        scene = self.scene
        if scene.colours.bayer == "none":
            return scene
        try:
            return scene.colour()
        except ParameterError:
            return scene

    def change(self, gesture: int = NO_GESTURE, **changes: ParameterValue) -> None:
        """Change parameters; an invalid change is refused with a sentence."""
        try:
            scene = self.scene.replace(**changes)
        except OccError as error:
            sentence = refusal_of(error)
            self.refused.emit(sentence)
            refused_names = [name for name in changes if name in error.parameters]
            self.refused_for.emit(sentence, tuple(refused_names or changes))
            return
        labels = " and ".join(PARAMETERS[name].in_sentence for name in changes)
        self.store.put(self._make_workspace(scene), f"change of {labels}", gesture)

    def force(self, effect: str, included: bool | None) -> None:
        """Switch an effect on or off, or leave it to the plan (None)."""
        force = dict(self.settings.settings.force)
        force.pop(effect, None)
        if included is not None:
            force[effect] = included
        text = switch_text(effect, included, self.settings.effect_labels)
        self.put(self.scene, f"switch: {text}", force=force)

    def release_effects(self) -> None:
        """Leave all effects to the plan, with the tolerance of a new window."""
        title = "return of all effects to the plan"
        self.store.put(replace(self.store.workspace, settings=self._make_planned_settings()), title)

    def _make_planned_settings(self) -> SimulationSettings:
        """Return the settings with all effects left to the plan, and the usual tolerance."""
        settings = self.settings.settings
        return replace(FIRST_SETTINGS, seed=settings.seed)

    def begin(self, scene: Scene, title: str, gesture: int = NO_GESTURE) -> None:
        """Replace the scene in one step, and leave all effects to the plan."""
        settings, former = self._make_planned_settings(), self.settings.settings
        self.store.put(replace(self._make_workspace(scene), settings=settings), title, gesture)
        if settings != former:
            self.noted.emit("The plan decides on all effects again, within the usual tolerance.")

    def put(
        self,
        scene: Scene,
        title: str,
        gesture: int = NO_GESTURE,
        force: Mapping[str, bool] | None = None,
        preset: str = "",
    ) -> None:
        """Replace the whole scene in one step, and the effects switched by hand if given.

        ``preset``: the preset that the scene is based on; by default, a scene with few changes
        keeps its preset.
        """
        workspace = self._make_workspace(scene, preset)
        if force is not None:
            workspace = workspace.with_force(force)
        self.store.put(workspace, title, gesture)

    def _make_workspace(self, scene: Scene, preset: str = "") -> Workspace:
        workspace, last_scene = self.store.workspace, self.scene
        changed_count = sum(scene.value(name) != last_scene.value(name) for name in PARAMETERS)
        preset = preset or (workspace.preset if changed_count <= _MOST_PARAMETERS_OF_EDIT else "")
        return replace(workspace, scene=scene, preset=preset)


PAUSE_MS = 700  # a longer pause between two changes of a control ends a gesture

_numbers = count()


def new_gesture() -> int:
    return next(_numbers)


class Gestures:
    """Numbers the gestures of a control: changes in quick succession are one."""

    def __init__(self) -> None:
        self._number = NO_GESTURE
        self._timer = QElapsedTimer()

    def end(self) -> None:
        """Begin a new gesture with the next change, however soon it follows."""
        self._timer.invalidate()

    def of_change(self, is_held: bool = False) -> int:
        """Return the gesture of a change made now; while held, a pause does not end it."""
        timer = self._timer
        if not timer.isValid() or (timer.hasExpired(PAUSE_MS) and not is_held):
            self._number = new_gesture()
        self._timer.start()
        return self._number
