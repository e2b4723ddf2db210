"""Document: the file of the scene, with its name and a mark for changes in the window's title."""

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from occ_gui.files.file_controller import FileController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.plain_text import in_title
from occ_model.scene.scene import Scene


class Document(QObject):
    """The file that the scene is saved to, and whether the scene has changed since."""

    def __init__(self, window: QWidget, store: SceneStore, files: FileController) -> None:
        super().__init__(window)
        self._window = window
        self._store = store
        self._files = files
        self._saved: Scene | None = store.scene
        self._photo: str | None = None
        self.path: Path | None = None
        files.scene_saved.connect(self._settle)
        files.scene_opened.connect(self._settle)
        store.changed.connect(self._mark)
        self._show_title()

    def save(self) -> None:
        """Save the scene to its file; if it has none, let the user choose one."""
        if self.path is None:
            self._files.ask_to_save_scene()
        else:
            self._files.save_scene(self.path)

    def resume(self, path: Path, saved: Scene | None) -> None:
        """Continue with the scene file of the last session."""
        self.path, self._saved = path, saved
        self._show_title()

    def show_photo(self, name: str | None) -> None:
        """Show the name of the open photo in the title, if any."""
        self._photo = name
        self._show_title()

    def _settle(self, path: Path) -> None:
        self.path, self._saved = path, self._store.scene
        self._show_title()

    def _show_title(self) -> None:
        title = "Optical Camera Communication"
        # A scene without a file is stored by the autosave: no mark asks for saving it.
        scene = "" if self.path is None else f"{in_title(self.path.name)}[*]"
        names = [name for name in (in_title(self._photo or ""), scene) if name]
        self._window.setWindowTitle(" – ".join((*names, title)))  # noqa: RUF001 - a dash
        self._mark(self._store.scene)

    def _mark(self, scene: Scene) -> None:
        changed = self.path is not None and scene != self._saved
        if changed != self._window.isWindowModified():
            self._window.setWindowModified(changed)
