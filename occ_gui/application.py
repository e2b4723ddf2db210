"""The one place where parts are put together."""

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMessageBox

import occ_model as occ
from occ_gui.controllers.accuracy import AccuracyController
from occ_gui.controllers.files import FileController
from occ_gui.controllers.photo import PhotoController
from occ_gui.controllers.simulation import SimulationController
from occ_gui.main_window import MainWindow
from occ_gui.state.gesture import new_gesture
from occ_gui.state.scene_store import SceneStore
from occ_gui.state.settings_store import FIRST_SETTINGS, SettingsStore
from occ_gui.state.snapshot import Snapshot
from occ_gui.views.accuracy_view import AccuracyView
from occ_gui.views.decode_view import DecodeView
from occ_gui.views.image_view import ImageView
from occ_gui.views.profile_view import ProfileView
from occ_gui.widgets.control_panel import ControlPanel
from occ_model.declarations import ParameterValue
from occ_model.effects.registry import EFFECTS
from occ_model.photo.load import Photo
from occ_model.presets import preset_named
from occ_model.scene import Scene
from occ_model.simulation_settings import SimulationSettings

# What a sentence in the status line can be shown until.
_CHANGE, _PICTURE, _PHOTO = "a change of the scene", "a picture", "a photo"


class Application(QObject):
    """Store, controllers, views and window, connected.

    Parameters
    ----------
    scene
        The scene to begin with.
    settings
        How it is simulated at first.
    """

    def __init__(self, scene: Scene, settings: SimulationSettings = FIRST_SETTINGS) -> None:
        super().__init__()
        self._preset_names = {occ.load_preset(name): name for name in occ.presets()}
        self.store, self.settings = SceneStore(scene), SettingsStore(settings)
        self.controls = ControlPanel(
            [(n, preset_named(n).title) for n in occ.presets()],
            [name for effect in EFFECTS for name in effect.parameters],
        )
        self.image, self.profile, self.decode = ImageView(), ProfileView(), DecodeView()
        self.accuracy = AccuracyView()
        self.window = MainWindow(
            self.controls, self.image, self.profile, self.decode, self.accuracy,
            self.store.undo_stack,
        )  # fmt: skip
        self.photos = PhotoController([self.image, self.profile])
        self.files = FileController(self.window, self.store, self.photos)
        self.simulation = SimulationController(
            self.store,
            self.settings,
            [self.image, self.profile, self.decode, self.accuracy, self.files],
        )
        self.study = AccuracyController(
            self.store, self.settings, self.simulation, self.accuracy.plot
        )
        self._connect_scene()
        self._connect_settings()
        self._connect_menus()
        self._show_scene(scene)
        self._show_settings(settings)

    def _connect_scene(self) -> None:
        self.controls.edited.connect(self._edit)
        self.controls.preset_chosen.connect(self._load_preset)
        self.store.changed.connect(self._show_scene)
        self.store.refused.connect(self._refuse)
        self.controls.refused.connect(self._say_refusal)
        self.simulation.shown.connect(self._on_shown)
        self.simulation.failed.connect(self._say_failure)
        self.photos.failed.connect(self._say_photo_failure)
        self.photos.opened.connect(self._on_photo)
        self.files.said.connect(self.window.say)
        self.window.closing.connect(self.stop)

    def _connect_settings(self) -> None:
        self.accuracy.tolerance_edited.connect(self._edit_tolerance)
        self.accuracy.observable_chosen.connect(self.settings.set_observable)
        self.accuracy.noise_chosen.connect(self.settings.set_noise)
        self.accuracy.effect_switched.connect(self.settings.force)
        self.accuracy.refused.connect(self._say_refusal)
        self.accuracy.shown.connect(self.study.set_seen)
        self.accuracy.plan_changed.connect(self.window.show_plan_change)
        self.settings.changed.connect(self._show_settings)
        self.settings.refused.connect(self._refuse_setting)

    def _connect_menus(self) -> None:
        for name, slot in {
            "open_photo": self.files.ask_for_photo,
            "close_photo": self.photos.close,
            "open_scene": self.files.ask_for_scene,
            "save_scene": self.files.ask_to_save_scene,
            "save_picture": self.files.ask_to_save_picture,
            "about": self._tell_about,
        }.items():
            self.window.actions_by_name[name].triggered.connect(slot)
        self.window.scan_axes.triggered.connect(self._scan_along)

    @property
    def is_idle(self) -> bool:
        """Whether all that was asked for is shown."""
        return self.simulation.runner.is_idle and self.photos.runner.is_idle

    def open_photo(self, path: Path) -> None:
        """Open a photo."""
        self.photos.open(path)

    def _edit(self, name: str, value: ParameterValue, gesture: int) -> None:
        self.window.happened(_CHANGE)  # also where the value that holds is entered again
        self.store.change(gesture, **{name: value})

    def _load_preset(self, name: str) -> None:
        self.store.put(occ.load_preset(name), f"preset {name}", new_gesture())

    def _show_scene(self, scene: Scene) -> None:
        self.window.happened(_CHANGE)
        self.controls.show_scene(scene)
        self.controls.show_preset(self._preset_names.get(scene))

    def _edit_tolerance(self, tolerance: float) -> None:
        self.window.happened(_CHANGE)  # also where the value that holds is entered again
        self.settings.set_tolerance(tolerance)

    def _show_settings(self, settings: SimulationSettings) -> None:
        self.window.happened(_CHANGE)
        self.accuracy.show_settings(settings)

    def _refuse_setting(self, sentence: str) -> None:
        self.accuracy.show_settings(self.settings.settings)
        self._say_refusal(sentence)

    def _refuse(self, sentence: str) -> None:
        # The control that asked shows what was asked for: let it show again what holds.
        self.controls.show_scene(self.store.scene)
        self._say_refusal(sentence)

    def _say_failure(self, sentence: str) -> None:
        self.window.say(sentence, until=_PICTURE)

    def _say_photo_failure(self, sentence: str) -> None:
        self.window.say(sentence, until=_PHOTO)

    def _say_refusal(self, sentence: str) -> None:
        self.window.say(sentence, until=_CHANGE)

    def _on_shown(self, snapshot: Snapshot) -> None:
        self.window.happened(_PICTURE)
        self.window.show_timing(snapshot.simulation_seconds, snapshot.reading_seconds)

    def _on_photo(self, photo: Photo | None) -> None:
        self.window.happened(_PHOTO)
        self.window.show_photo_name(None if photo is None else photo.path.name)

    def _scan_along(self, action: QAction) -> None:
        self.photos.scan_along(action.data())

    def _tell_about(self) -> None:
        QMessageBox.about(
            self.window,
            self.tr("About"),
            self.tr(
                "Optical Camera Communication {version}\n\nSimulates the pictures that a rolling-"
                "shutter camera takes of a blinking LED panel, and reads the code from them."
            ).format(version=occ.__version__),
        )

    def stop(self) -> None:
        """Let the work in the background end."""
        self.simulation.stop()
        self.study.stop()
        self.photos.stop()
