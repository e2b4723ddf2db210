"""Hold the brightness: the ISO speed moves against the exposure time."""

from PySide6.QtCore import QObject, Signal

from occ_gui.scene.scene_store import SceneStore
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

_EXPOSURE, _ISO = "exposure_time", "iso"


class HoldBrightness(QObject):
    """Changes parameters; while it is on, S t of equation (1) stays what it was.

    Parameters
    ----------
    store
        The scene.
    """

    switched = Signal(bool)
    """Whether the brightness is held from now on."""

    status_message = Signal(str)
    """Why the brightness could not be held."""

    def __init__(self, store: SceneStore) -> None:
        super().__init__()
        self._store = store
        self._on = False
        self._product = 0.0
        self._asked: tuple[float, float] | None = None
        self._look(store.scene)
        store.changed.connect(self._look)

    @property
    def is_on(self) -> bool:
        """Whether the brightness is held."""
        return self._on

    def switch(self, on: bool) -> None:
        """Hold the brightness that the scene has now, or let it go."""
        self._asked = None
        self._look(self._store.scene)
        if on != self._on:
            self._on = on
            self.switched.emit(on)

    def change(self, gesture: int, name: str, value: ParameterValue) -> None:
        """Change a parameter, and the ISO speed with the exposure time."""
        time = value if isinstance(value, float) else 0.0
        if not self._on or name != _EXPOSURE or time <= 0.0:
            self._store.change(gesture, **{name: value})
            return
        iso = quantity(_ISO)
        low, high = iso.slider
        wanted = self._product / time
        held = min(max(wanted, low), high)
        self._asked = (time, held)
        self._store.change(gesture, **{_EXPOSURE: time, _ISO: held})
        if held != wanted:
            self.status_message.emit(
                self.tr(
                    "The brightness cannot be held: it takes ISO {wanted}; the slider goes from "
                    "{low} to {high}."
                ).format(wanted=iso.format(wanted), low=iso.format(low), high=iso.format(high))
            )

    def _look(self, scene: Scene) -> None:
        """Take the brightness that others give; one at the slider's end is not what is wanted."""
        camera = scene.camera
        if (camera.exposure_time, camera.iso) != self._asked:
            self._asked = None
            self._product = camera.iso * camera.exposure_time
