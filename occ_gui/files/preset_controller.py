"""Preset controller: loads, saves and deletes presets, built-in and the user's own."""

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QInputDialog, QLineEdit, QMessageBox, QWidget

from occ_gui.scene.scene_store import SceneStore, new_gesture
from occ_gui.widgets.plain_text import LONGEST_TEXT
from occ_model.errors import OccError, one_line
from occ_model.scene.presets import delete_preset, preset_named, read_presets
from occ_model.scene.scene import Scene

if TYPE_CHECKING:
    from occ_gui.photo.match_controller import MatchController


class PresetController(QObject):
    status_message = Signal(str)
    changed = Signal()

    def __init__(self, window: QWidget, scenes: SceneStore) -> None:
        super().__init__(window)
        self._window = window
        self._scenes = scenes
        self._loaded = read_presets()
        self._record_preset()
        scenes.changed.connect(self._record_preset)

    @property
    def titles(self) -> list[tuple[str, str]]:
        """Names and titles of the presets, the built-in ones before the user's own."""
        return [(preset.name, preset.title) for preset in self._loaded.every]

    @property
    def user_presets(self) -> tuple[str, ...]:
        return tuple(preset.name for preset in self._loaded.own)

    @property
    def unreadable(self) -> list[tuple[str, str]]:
        """Names of the user's preset files that cannot be read, with the reasons."""
        problems = self._loaded.problems
        return [(name, one_line(reason, LONGEST_TEXT)) for name, reason in problems.items()]

    def name_of(self, scene: Scene) -> str:
        return next((p.name for p in self._loaded.every if p.scene == scene), "")

    @property
    def shown_names(self) -> tuple[str, str]:
        """Names of the preset of the scene, and of the one it was changed from; empty for none."""
        name = self.name_of(self._scenes.scene)
        return name, "" if name else self._scenes.store.workspace.preset

    def _record_preset(self) -> None:
        store = self._scenes.store
        if name := self.name_of(self._scenes.scene):
            store.put(replace(store.workspace, preset=name))

    def load(self, name: str) -> None:
        """Load the scene of a preset, as one undo step."""
        try:
            preset = preset_named(name)
        except OccError as error:  # its file may have changed meanwhile
            self.status_message.emit(one_line(str(error), LONGEST_TEXT))
            self.update()
            return
        shown = name if name in self.user_presets else preset.title  # as in the list
        self._scenes.begin(preset.scene, f"preset {one_line(shown)}", new_gesture())

    def ask_to_save_match(self, matching: "MatchController") -> None:
        photo = matching.photo
        if photo is None or matching.match is None:
            self.status_message.emit("There is no match to save yet.")
            return
        name, is_accepted = QInputDialog.getText(
            self._window,
            "Save as preset",
            "Name of the preset: letters, digits, spaces, - and _",
            QLineEdit.EchoMode.Normal,
            re.sub(r"[^A-Za-z0-9 _-]+", "-", photo.camera or photo.path.stem).strip(" -_")[:60],
        )
        if is_accepted and self._may_replace(name):
            title = f"Measured from {one_line(photo.path.name)}"
            if matching.save(name, title):
                self.update()
                self.status_message.emit(f"Saved the preset {name}")

    def ask_to_delete(self) -> None:
        names = _list_own_names()
        if not names:
            self.status_message.emit("There is no preset of your own.")
            return
        name, is_accepted = QInputDialog.getItem(
            self._window, "Delete preset", "Preset to delete", names, 0, False
        )
        if not is_accepted:
            return
        try:
            delete_preset(name)
        except OccError as error:
            self.status_message.emit(str(error))
            return
        self.update()
        self.status_message.emit(f"Deleted the preset {name}")

    def _may_replace(self, name: str) -> bool:
        if name not in _list_own_names():
            return True
        answer = QMessageBox.question(
            self._window, "Save as preset", f"There is a preset {name} already. Replace it?"
        )
        return answer == QMessageBox.StandardButton.Yes

    def update(self) -> None:
        self._loaded = read_presets()
        self._record_preset()
        self.changed.emit()


def _list_own_names() -> list[str]:
    """List the names of the user's preset files, those that cannot be read last."""
    loaded = read_presets()
    return [*(preset.name for preset in loaded.own), *loaded.problems]
