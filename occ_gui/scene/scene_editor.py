"""Scene editor: makes the changes that the controls ask for, by the rule of held brightness."""

from PySide6.QtCore import QObject, Signal

from occ_gui.scene.hold_brightness import HoldBrightness
from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.parameter_kinds import ParameterValue


class SceneEditor(QObject):
    """Receives the edits of all controls and changes the scene in the store."""

    edit_started = Signal()  # a value was entered, whether or not it differs from the scene's
    input_refused = Signal(str)  # the reason why an input is not valid

    def __init__(self, store: SceneStore) -> None:
        super().__init__()
        self._store = store
        self.brightness = HoldBrightness(store)

    def edit(self, name: str, value: ParameterValue, gesture: int) -> None:
        """Change a parameter, and the ISO speed with it where the brightness is held.

        ``gesture``: the number of the gesture: changes of one gesture are undone as one step.
        """
        self.edit_started.emit()
        self._store.change(gesture, **self.brightness.changes(name, value))
        self.brightness.report_limit()
