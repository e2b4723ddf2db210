"""Scene store: edits of the scene and of the effects forced by hand, each a step to undo."""

from collections.abc import Mapping
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from occ_gui.core.store import NO_GESTURE, Store
from occ_gui.core.workspace import Workspace
from occ_gui.scene.forced_effects import switch_text
from occ_gui.scene.settings_store import SettingsStore
from occ_model.errors import OccError
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.refusal import refusal_of
from occ_model.scene.scene import Scene

_MOST_OF_A_CHANGE = 2
"""Parameters that one change of the user has at most: the exposure and, held by it, the ISO."""


class SceneStore(QObject):
    changed = Signal(object)

    refused = Signal(str)  # the reason why a change was not made; the scene is unchanged

    refused_for = Signal(str, object)
    """The same, and the names of the parameters that were to be changed."""

    def __init__(self, store: Store, effect_labels: Mapping[str, str] | None = None) -> None:
        super().__init__()
        self.store = store
        self.settings = SettingsStore(store, effect_labels)
        self.undo_stack = store.undo_stack
        store.select(lambda workspace: workspace.scene).changed.connect(self.changed)

    @property
    def scene(self) -> Scene:
        return self.store.workspace.scene

    def change(self, gesture: int = NO_GESTURE, **changes: ParameterValue) -> None:
        """Change parameters; an invalid change is refused with a sentence."""
        try:
            scene = self.scene.replace(**changes)
        except OccError as error:
            sentence = refusal_of(error)
            self.refused.emit(sentence)
            at_fault = [name for name in changes if name in error.parameters]
            self.refused_for.emit(sentence, tuple(at_fault or changes))
            return
        labels = " and ".join(PARAMETERS[name].label.lower() for name in changes)
        self.store.put(self._with(scene), f"change of {labels}", gesture)

    def force(self, effect: str, included: bool | None) -> None:
        """Switch an effect on or off, or leave it to the plan (None)."""
        now = self.settings.settings.force
        force = {name: on for name, on in now.items() if name != effect}
        if included is not None:
            force[effect] = included
        text = switch_text(effect, included, self.settings.effect_labels)
        self.put(self.scene, f"switch: {text}", force=force)

    def release_effects(self) -> None:
        self.put(self.scene, "return of all effects to the plan", force={})

    def put(
        self,
        scene: Scene,
        title: str,
        gesture: int = NO_GESTURE,
        force: Mapping[str, bool] | None = None,
        preset: str = "",
    ) -> None:
        """Replace the whole scene as one step, and the effects forced by hand if they are given.

        The preset is what a whole other scene was changed from; one that is changed a little keeps
        its own.
        """
        workspace = self._with(scene, preset)
        if force is not None:
            workspace = workspace.with_force(force)
        self.store.put(workspace, title, gesture)

    def _with(self, scene: Scene, preset: str = "") -> Workspace:
        workspace, last = self.store.workspace, self.scene
        changed = sum(scene.value(name) != last.value(name) for name in PARAMETERS)
        preset = preset or (workspace.preset if changed <= _MOST_OF_A_CHANGE else "")
        return replace(workspace, scene=scene, preset=preset)
