"""The document: the file of the scene, its name and unsaved changes in the window's title."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QMessageBox, QWidget

from occ_gui.files.file_controller import FileController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.plain_text import in_title
from occ_model.errors import one_line
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.scene import Scene

if TYPE_CHECKING:
    from occ_model.photo.reading.load import Photo


class Document(QObject):
    """The file that the scene is saved to, and whether the scene has changed since."""

    photo_named = Signal(str)  # the name of the open photo; empty if none is

    def __init__(self, window: QWidget, scenes: SceneStore, files: FileController) -> None:
        super().__init__(window)
        self._window = window
        self._scenes = scenes
        self._files = files
        self._saved_scene: Scene | None = None
        self._photo_name = ""
        files.scene_saved.connect(self._adopt_file)
        files.scene_opened.connect(self._adopt_file)
        scenes.changed.connect(self._mark_changes)
        path = scenes.store.select(lambda workspace: workspace.scene_file)
        path.changed.connect(self._compare_with_file)
        self._show_title()

    @property
    def path(self) -> Path | None:
        return self._scenes.store.workspace.scene_file

    def save(self) -> None:
        """Save the scene to its file; if it has none, ask the user for one."""
        if self.path is None:
            self._files.ask_to_save_scene()
        else:
            self._files.save_scene(self.path)

    def may_close(self) -> bool:
        """Ask whether to save a scene that has changed since it was saved; False to stay open."""
        if self.path is None or not self._window.isWindowModified():
            return True
        buttons = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self._window,
            "Unsaved changes",
            f"Save the changes of the scene to {one_line(self.path.name)}?\n\nIf you discard "
            "them, the file stays as it is. The next start still shows the changed scene.",
            buttons.Save | buttons.Discard | buttons.Cancel,
            buttons.Save,
        )
        if answer == buttons.Save:
            self.save()
            return not self._window.isWindowModified()
        return answer == buttons.Discard

    def show_photo(self, photo: "Photo | None") -> None:
        self._photo_name = "" if photo is None else photo.path.name
        self.photo_named.emit(self._photo_name)
        self._show_title()

    def _adopt_file(self, path: Path) -> None:
        store = self._scenes.store
        store.put(replace(store.workspace, scene_file=path))
        self._saved_scene = self._scenes.scene
        self._show_title()

    def _compare_with_file(self, path: Path | None) -> None:
        """Compare the scene with its file, which may have been saved before this start."""
        self._saved_scene = None if path is None else _read_scene(path)
        self._show_title()

    def _show_title(self) -> None:
        title = "Optical Camera Communication"
        # A scene without a file is stored in the session, so no mark asks to save it.
        scene = "" if self.path is None else f"{in_title(self.path.name)}[*]"
        names = [name for name in (in_title(self._photo_name), scene) if name]
        self._window.setWindowTitle(" – ".join((*names, title)))  # noqa: RUF001 - a dash
        self._mark_changes(self._scenes.scene)

    def _mark_changes(self, scene: Scene) -> None:
        has_changed = self.path is not None and scene != self._saved_scene
        if has_changed != self._window.isWindowModified():
            self._window.setWindowModified(has_changed)


def _read_scene(path: Path) -> Scene | None:
    try:
        return read_scene_file(path)
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return None
