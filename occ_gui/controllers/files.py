"""The file menu: dialogs, and reading and writing scenes and pictures."""

from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.controllers.photo import PhotoController
from occ_gui.state.scene_store import SceneStore
from occ_gui.state.snapshot import Snapshot
from occ_model.errors import OccError
from occ_model.output import PICTURE_ENDINGS, write_image, write_whole
from occ_model.settings import read_scene_file

_PICTURES = " ".join(f"*{ending}" for ending in PICTURE_ENDINGS)
_PHOTOS = f"{_PICTURES} *.heic *.heif"


class FileController(QObject):
    """Does what the file menu says.

    Parameters
    ----------
    window
        The window that dialogs belong to.
    store
        The scene.
    photos
        Opens photos.
    """

    said = Signal(str)
    """What was done, or why it was not."""

    def __init__(self, window: QWidget, store: SceneStore, photos: PhotoController) -> None:
        super().__init__(window)
        self._window = window
        self._store = store
        self._photos = photos
        self._snapshot: Snapshot | None = None

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Keep the picture that is on the screen, which is the one to save."""
        self._snapshot = snapshot

    def ask_for_photo(self) -> None:
        """Let the user choose a photo and open it."""
        name, _ = QFileDialog.getOpenFileName(
            self._window,
            self.tr("Open photo"),
            "",
            self.tr("Photos ({patterns});;All files (*)").format(patterns=_PHOTOS),
        )
        if name:
            self._photos.open(Path(name))

    def ask_for_scene(self) -> None:
        """Let the user choose a scene file and open it."""
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Open scene"), "", self.tr("Scenes (*.toml);;All files (*)")
        )
        if name:
            self.open_scene(Path(name))

    def open_scene(self, path: Path) -> None:
        """Open a scene file; a bad one leaves the scene as it is."""
        try:
            scene = read_scene_file(path)
        except OccError as error:
            self.said.emit(str(error))
            return
        self._store.put(scene, f"opening of {path.name}")
        self.said.emit(self.tr("Opened {name}").format(name=path.name))

    def ask_to_save_scene(self) -> None:
        """Let the user choose where to save the scene."""
        name, _ = QFileDialog.getSaveFileName(
            self._window, self.tr("Save scene"), "scene.toml", self.tr("Scenes (*.toml)")
        )
        if name:
            self.save_scene(Path(name))

    def save_scene(self, path: Path) -> None:
        """Write the scene to a file."""
        try:
            write_whole(path, self._store.scene.to_toml().encode("utf-8"))
        except OccError as error:
            self.said.emit(str(error))
            return
        self.said.emit(self.tr("Saved {name}").format(name=path.name))

    def ask_to_save_picture(self) -> None:
        """Let the user choose where to save the simulated picture."""
        name, _ = QFileDialog.getSaveFileName(
            self._window,
            self.tr("Save simulated picture"),
            "simulation.png",
            self.tr("Pictures ({patterns})").format(patterns=_PICTURES),
        )
        if name:
            self.save_picture(Path(name))

    def save_picture(self, path: Path) -> None:
        """Write the picture on the screen to a file, at its full size."""
        if self._snapshot is None:
            self.said.emit(self.tr("There is no picture yet."))
            return
        try:
            write_image(path, self._snapshot.frame.image)
        except OccError as error:
            self.said.emit(str(error))
            return
        self.said.emit(self.tr("Saved {name}").format(name=path.name))
