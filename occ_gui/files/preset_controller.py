"""Preset controller: load, save and delete presets of the program and of the user."""

import re
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QInputDialog, QLineEdit, QMessageBox, QWidget

from occ_gui.core.store import MOST_STEPS
from occ_gui.scene.gesture import new_gesture
from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.plain_text import LONGEST
from occ_model.errors import OccError, one_line
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.preset_file import Preset
from occ_model.scene.presets import (
    all_presets,
    delete_preset,
    preset_named,
    unreadable_presets,
    user_presets,
)
from occ_model.scene.scene import Scene

if TYPE_CHECKING:
    from occ_gui.photo.match_controller import MatchController

_MOST_OF_A_CHANGE = 2
"""Parameters that one change of the user has at most: the exposure and, held by it, the ISO."""


def _differences(one: Scene, other: Scene) -> int:
    """Count the parameters in which two scenes differ."""
    return sum(one.value(name) != other.value(name) for name in PARAMETERS)


class PresetController(QObject):
    """Keeps the list of presets and carries out the commands for them."""

    status_message = Signal(str)
    """The outcome of a command."""

    changed = Signal()
    """The list of presets has changed."""

    def __init__(self, window: QWidget, store: SceneStore) -> None:
        super().__init__(window)
        self._window = window
        self._store = store
        self._own: tuple[str, ...] = ()
        self._followed: Scene | None = None
        self._base: str | None = None
        self._bases: dict[Scene, str] = {}
        self._presets: list[Preset] = []
        self._unreadable: dict[str, str] = {}
        self._read()

    @property
    def titles(self) -> list[tuple[str, str]]:
        """Names and titles of the presets: first those of the program, then those of the user."""
        return [(preset.name, preset.title) for preset in self._presets]

    @property
    def unreadable(self) -> list[tuple[str, str]]:
        """Names of the user's preset files that cannot be read, with the reasons."""
        return list(self._unreadable.items())

    @property
    def own(self) -> tuple[str, ...]:
        """Names of the user's presets."""
        return self._own

    def name_of(self, scene: Scene) -> str | None:
        """Return the name of the preset that equals a scene, None if there is none."""
        return next((p.name for p in self._presets if p.scene == scene), None)

    def follow(self, scene: Scene) -> tuple[str | None, str | None]:
        """Follow the scene from change to change.

        Returns
        -------
        name
            The preset that it equals, None if there is none.
        changed
            In that case the preset that it was before some of its values were changed, one or a
            few at a time. None where a whole other scene has come meanwhile, until that of before
            comes back: by undo, or at the end of a lesson.
        """
        name, last = self.name_of(scene), self._followed
        is_other = last is None or _differences(last, scene) > _MOST_OF_A_CHANGE
        if name is not None or is_other:
            self.keep_base()
        self._followed = scene
        if name is not None:
            self._base = name
            return name, None
        self._base = self._bases.get(scene, None if is_other else self._base)
        return None, self._base

    def keep_base(self) -> None:
        """Keep which preset the present scene was, for when it comes back as a whole."""
        if self._followed is None or self._base is None:
            return
        self._bases.pop(self._followed, None)  # so that it is the newest
        self._bases[self._followed] = self._base
        if len(self._bases) > MOST_STEPS:
            del self._bases[next(iter(self._bases))]

    def base_of(self, scene: Scene) -> str:
        """Return the preset that the present or an earlier scene was; empty where none is known."""
        base = self._base if scene == self._followed else self._bases.get(scene)
        return base or ""

    def resume(self, scene: Scene, base: str) -> None:
        """Have a scene of an earlier window be what a preset was changed to."""
        if base:
            self._followed, self._base = scene, base
            self.keep_base()
            self._followed = None  # so that the present scene is looked for among the kept ones
            self.changed.emit()

    def load(self, name: str) -> None:
        """Load the scene of a preset, as one step that can be undone."""
        try:
            scene = preset_named(name).scene
        except OccError as error:  # its file may have changed meanwhile
            self.status_message.emit(one_line(str(error), LONGEST))
            self._update()
            return
        title = f"preset {name}"
        self._store.put(scene, title, new_gesture(), force={})

    def ask_to_save_match(self, matching: "MatchController") -> None:
        """Let the user name a preset, and save the result of a match as it."""
        photo = matching.photo
        if photo is None or matching.match is None:
            self.status_message.emit("There is no match yet that could be saved.")
            return
        name, wanted = QInputDialog.getText(
            self._window,
            "Save as preset",
            "Name of the preset: letters, digits, spaces, - and _",
            QLineEdit.EchoMode.Normal,
            re.sub(r"[^A-Za-z0-9 _-]+", "-", photo.camera or photo.path.stem).strip(" -_")[:60],
        )
        if wanted and self._may_replace(name):
            title = f"Measured from {one_line(photo.path.name)}"
            matching.save(name, title)

    def ask_to_delete(self) -> None:
        """Let the user choose one of the saved presets, and delete it."""
        own = [*user_presets(), *self._unreadable]
        if not own:
            self.status_message.emit("There is no preset of your own.")
            return
        name, wanted = QInputDialog.getItem(
            self._window, "Delete preset", "Preset to delete", own, 0, False
        )
        if not wanted:
            return
        try:
            delete_preset(name)
        except OccError as error:
            self.status_message.emit(str(error))
            return
        self._update()
        self.status_message.emit(f"Deleted the preset {name}")

    def _may_replace(self, name: str) -> bool:
        if name not in user_presets() and name not in self._unreadable:
            return True
        answer = QMessageBox.question(
            self._window,
            "Save as preset",
            f"There is a preset {name} already. Replace it?",
        )
        return answer == QMessageBox.StandardButton.Yes

    def report_saved(self, name: str) -> None:
        """List a preset that was saved from a match."""
        self._update()
        self.status_message.emit(f"Saved the preset {name}")

    def _update(self) -> None:
        self._read()
        self.changed.emit()

    def _read(self) -> None:
        self._presets = list(all_presets())
        self._own = user_presets()
        self._unreadable = {
            name: one_line(reason, LONGEST) for name, reason in unreadable_presets().items()
        }
