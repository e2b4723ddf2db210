"""Presets: those of the program and the user's own, loaded, saved and deleted."""

import re

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QInputDialog, QLineEdit, QMessageBox, QWidget

from occ_gui.photo.match_controller import MatchController
from occ_gui.scene.gesture import new_gesture
from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.plain_text import LONGEST
from occ_model.errors import OccError, one_line
from occ_model.scene.preset_file import Preset
from occ_model.scene.presets import (
    all_presets,
    delete_preset,
    preset_named,
    unreadable_presets,
    user_presets,
)
from occ_model.scene.scene import Scene


class PresetController(QObject):
    """Keeps the list of presets, and does what the user wants with them.

    Parameters
    ----------
    window
        The window that dialogs belong to.
    store
        Takes a preset's scene.
    matching
        Gives what is to be saved.
    """

    status_message = Signal(str)
    """What was done, or why it was not."""

    changed = Signal()
    """There are other presets now."""

    def __init__(self, window: QWidget, store: SceneStore, matching: MatchController) -> None:
        super().__init__(window)
        self._window = window
        self._store = store
        self._matching = matching
        self._presets: list[Preset] = []
        self._unreadable: dict[str, str] = {}
        self._read()
        matching.saved.connect(self._tell_saved)

    @property
    def titles(self) -> list[tuple[str, str]]:
        """Names and titles of the presets: the program's first, then the user's own."""
        return [(preset.name, preset.title) for preset in self._presets]

    @property
    def unreadable(self) -> list[tuple[str, str]]:
        """Names of the user's own preset files that cannot be read, and why."""
        return list(self._unreadable.items())

    def name_of(self, scene: Scene) -> str | None:
        """Give the name of the preset that a scene is, None if it is none."""
        return next((p.name for p in self._presets if p.scene == scene), None)

    def load(self, name: str) -> None:
        """Put a preset's scene in place of the scene, as one step."""
        try:
            scene = preset_named(name).scene
        except OccError as error:  # its file may have become anything meanwhile
            self.status_message.emit(one_line(str(error), LONGEST))
            self._update()
            return
        self._store.put(scene, self.tr("preset {name}").format(name=name), new_gesture())

    def ask_to_save_match(self) -> None:
        """Let the user name a preset, and save what the match found as it."""
        photo = self._matching.photo
        if photo is None or self._matching.match is None:
            self.status_message.emit(self.tr("There is no match yet that could be saved."))
            return
        name, wanted = QInputDialog.getText(
            self._window,
            self.tr("Save as preset"),
            self.tr("Name of the preset: letters, digits, spaces, - and _"),
            QLineEdit.EchoMode.Normal,
            re.sub(r"[^A-Za-z0-9 _-]+", "-", photo.camera or photo.path.stem).strip(" -_")[:60],
        )
        if wanted and self._may_replace(name):
            title = self.tr("Measured from {photo}").format(photo=one_line(photo.path.name))
            self._matching.save(name, title)

    def ask_to_delete(self) -> None:
        """Let the user choose one of the own presets, and delete it."""
        own = [*user_presets(), *self._unreadable]
        if not own:
            self.status_message.emit(self.tr("There is no preset of your own."))
            return
        name, wanted = QInputDialog.getItem(
            self._window, self.tr("Delete preset"), self.tr("Preset to delete"), own, 0, False
        )
        if not wanted:
            return
        try:
            delete_preset(name)
        except OccError as error:
            self.status_message.emit(str(error))
            return
        self._update()
        self.status_message.emit(self.tr("Deleted the preset {name}").format(name=name))

    def _may_replace(self, name: str) -> bool:
        if name not in user_presets() and name not in self._unreadable:
            return True
        answer = QMessageBox.question(
            self._window,
            self.tr("Save as preset"),
            self.tr("There is a preset {name} already. Replace it?").format(name=name),
        )
        return answer == QMessageBox.StandardButton.Yes

    def _tell_saved(self, name: str) -> None:
        self._update()
        self.status_message.emit(self.tr("Saved the preset {name}").format(name=name))

    def _update(self) -> None:
        self._read()
        self.changed.emit()

    def _read(self) -> None:
        self._presets = list(all_presets())
        self._unreadable = {
            name: one_line(reason, LONGEST) for name, reason in unreadable_presets().items()
        }
