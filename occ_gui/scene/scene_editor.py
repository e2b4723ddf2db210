"""Scene editor: applies the edits of all controls, and keeps the brightness if chosen."""

from PySide6.QtCore import QObject, Signal

from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

_EXPOSURE, _ISO = "exposure_time", "iso"


class BrightnessHold(QObject):
    """While on, keeps the product S t of equation (1) when the exposure time t changes."""

    switched = Signal(bool)

    status_message = Signal(str)  # the reason why the brightness could not be kept

    def __init__(self, scenes: SceneStore) -> None:
        super().__init__()
        self._scenes = scenes
        self.is_on = False
        self._product = 0.0
        self._last_change: tuple[float, float] | None = None
        self._limit_message = ""
        self._record_product(scenes.scene)
        scenes.changed.connect(self._record_product)

    def switch(self, on: bool) -> None:
        self._last_change = None
        self._record_product(self._scenes.scene)
        if on != self.is_on:
            self.is_on = on
            self.switched.emit(on)

    def add_iso_change(self, name: str, value: ParameterValue) -> dict[str, ParameterValue]:
        """Return the change of a parameter, and the ISO speed with it if the brightness is kept."""
        self._limit_message = ""
        time = value if isinstance(value, float) else 0.0
        if not self.is_on or name != _EXPOSURE or time <= 0.0:
            return {name: value}
        iso = quantity(_ISO)
        low, high = iso.slider
        exact_speed = self._product / time
        speed = min(max(exact_speed, low), high)
        self._last_change = (time, speed)
        if speed != exact_speed:
            self._limit_message = (
                f"The brightness cannot be kept: it would take ISO {iso.format(exact_speed)}; the "
                f"slider goes from {iso.format(low)} to {iso.format(high)}."
            )
        return {_EXPOSURE: time, _ISO: speed}

    def report_limit(self) -> None:
        """Report, after the change, that the ISO speed has reached an end of its slider."""
        if self._limit_message:
            self.status_message.emit(self._limit_message)

    def _record_product(self, scene: Scene) -> None:
        # Not after a change made here: with the ISO speed at an end of its slider, the product
        # is no longer the one to keep.
        camera = scene.camera
        if (camera.exposure_time, camera.iso) != self._last_change:
            self._last_change = None
            self._product = camera.iso * camera.exposure_time


class SceneEditor(QObject):
    """Changes the scene in the store as the controls ask."""

    edit_started = Signal()  # a value was entered, whether or not it differs from the scene's
    input_refused = Signal(str)  # the reason why an input is not valid

    def __init__(self, scenes: SceneStore) -> None:
        super().__init__()
        self._scenes = scenes
        self.brightness = BrightnessHold(scenes)

    def edit(self, name: str, value: ParameterValue, gesture: int) -> None:
        """Change a parameter, and with it the ISO speed if the brightness is kept.

        ``gesture``: changes of one gesture are undone as one step.
        """
        self.edit_started.emit()
        self._scenes.change(gesture, **self.brightness.add_iso_change(name, value))
        self.brightness.report_limit()
