"""Document: the file of the scene, with its name and a mark for changes in the window's title."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from occ_gui.files.file_controller import FileController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.plain_text import in_title
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.scene import Scene

if TYPE_CHECKING:
    from occ_model.photo.reading.load import Photo


class Document(QObject):
    """The file that the scene is saved to, and whether the scene has changed since."""

    def __init__(self, window: QWidget, store: SceneStore, files: FileController) -> None:
        super().__init__(window)
        self._window = window
        self._store = store
        self._files = files
        self._saved: Scene | None = None
        self._photo = ""
        files.scene_saved.connect(self._settle)
        files.scene_opened.connect(self._settle)
        store.changed.connect(self._mark)
        path = store.store.select(lambda workspace: workspace.scene_file)
        path.changed.connect(self._on_path)
        self._show_title()

    @property
    def path(self) -> Path | None:
        return self._store.store.workspace.scene_file

    def save(self) -> None:
        """Save the scene to its file, which the user chooses where there is none."""
        if self.path is None:
            self._files.ask_to_save_scene()
        else:
            self._files.save_scene(self.path)

    def show_photo(self, photo: "Photo | None") -> None:
        self._photo = "" if photo is None else photo.path.name
        self._show_title()

    def _settle(self, path: Path) -> None:
        store = self._store.store
        store.put(replace(store.workspace, scene_file=path))
        self._saved = self._store.scene
        self._show_title()

    def _on_path(self, path: Path | None) -> None:
        """Compare with what is in the file: an earlier window may have left it."""
        self._saved = None if path is None else _saved_in(path)
        self._show_title()

    def _show_title(self) -> None:
        title = "Optical Camera Communication"
        # A scene without a file is kept in the session: no mark asks for saving it.
        scene = "" if self.path is None else f"{in_title(self.path.name)}[*]"
        names = [name for name in (in_title(self._photo), scene) if name]
        self._window.setWindowTitle(" – ".join((*names, title)))  # noqa: RUF001 - a dash
        self._mark(self._store.scene)

    def _mark(self, scene: Scene) -> None:
        changed = self.path is not None and scene != self._saved
        if changed != self._window.isWindowModified():
            self._window.setWindowModified(changed)


def _saved_in(path: Path) -> Scene | None:
    try:
        return read_scene_file(path)
    except Exception:  # noqa: BLE001 - the window starts whatever the file contains
        return None
