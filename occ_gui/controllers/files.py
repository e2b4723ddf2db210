"""The file menu: dialogs, and reading and writing scenes, photos and pictures."""

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.controllers.photo import PhotoController
from occ_gui.state.memory import Memory
from occ_gui.state.scene_store import SceneStore
from occ_gui.state.snapshot import Snapshot
from occ_model.errors import OccError
from occ_model.output import PICTURE_ENDINGS, write_image, write_whole
from occ_model.photo.load import Photo
from occ_model.resource_files import resource_path
from occ_model.settings import read_scene_file

_PICTURES = " ".join(f"*{ending}" for ending in PICTURE_ENDINGS)
_PHOTOS = f"{_PICTURES} *.heic *.heif *.avif *.gif *.ppm *.pgm *.jp2"

_SCENE = ".toml"


def sample_photos() -> list[Path]:
    """List the photos that come with the program, by name."""
    return sorted(resource_path("photos").glob("*.jpg"))


class FileController(QObject):
    """Does what the file menu says, and opens what is dropped on the window.

    Parameters
    ----------
    window
        The window that dialogs belong to.
    store
        The scene.
    photos
        Opens photos.
    memory
        Remembers files and folders.
    """

    said = Signal(str)
    """What was done, or why it was not."""

    def __init__(
        self, window: QWidget, store: SceneStore, photos: PhotoController, memory: Memory
    ) -> None:
        super().__init__(window)
        self._window = window
        self._store = store
        self._photos = photos
        self._memory = memory
        self._snapshot: Snapshot | None = None
        photos.opened.connect(self._remember)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Keep the picture that is on the screen, which is the one to save."""
        self._snapshot = snapshot

    def ask_for_photo(self) -> None:
        """Let the user choose a photo and open it."""
        kinds = self.tr("Photos ({patterns});;All files (*)").format(patterns=_PHOTOS)
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Open photo"), self._memory.folder, kinds
        )
        if name:
            self._photos.open(Path(name))

    def ask_for_scene(self) -> None:
        """Let the user choose a scene file and open it."""
        kinds = self.tr("Scenes (*.toml);;All files (*)")
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Open scene"), self._memory.folder, kinds
        )
        if name:
            self.open_scene(Path(name))

    def open_file(self, path: Path) -> None:
        """Open a scene file or a photo, whichever it is."""
        if path.suffix.lower() == _SCENE:
            self.open_scene(path)
        else:
            self._photos.open(path)

    def open_recent(self, path: Path) -> None:
        """Open a file that was opened before; one that has gone is forgotten."""
        if path.is_file():
            self.open_file(path)
            return
        self._memory.drop(path)
        self.said.emit(self.tr("{path} is no longer there.").format(path=path))

    def open_sample(self, path: Path) -> None:
        """Open a photo that comes with the program, with the scene that belongs to it."""
        scene = path.with_suffix(_SCENE)
        if scene.is_file():
            self._put_scene(scene)
        self._photos.open(path)

    def open_dropped(self, paths: Sequence[Path]) -> None:
        """Open the first scene and the first photo of what was dropped on the window."""
        files = [path for path in paths if path.is_file()]
        scenes = [path for path in files if path.suffix.lower() == _SCENE]
        photos = [path for path in files if path not in scenes]
        if not files:
            what = self.tr("{path} is no file").format(path=paths[0]) if paths else ""
            what = what or self.tr("What was dropped is no file of this computer")
            self.said.emit(self.tr("{what}; drop a photo or a scene (.toml).").format(what=what))
            return
        for path in scenes[:1]:
            self.open_scene(path)
        for path in photos[:1]:
            self._photos.open(path)
        opened = [path.name for path in (*scenes[:1], *photos[:1])]
        if len(paths) > len(opened):
            self.said.emit(
                self.tr("Of {count} things that were dropped, only {names} can be shown.").format(
                    count=len(paths), names=self.tr(" and ").join(opened)
                )
            )

    def open_scene(self, path: Path) -> None:
        """Open a scene file; a bad one leaves the scene as it is."""
        if self._put_scene(path):
            self._memory.add(path)
            self.said.emit(self.tr("Opened {name}").format(name=path.name))

    def _put_scene(self, path: Path) -> bool:
        try:
            scene = read_scene_file(path)
        except OccError as error:
            self.said.emit(str(error))
            return False
        self._store.put(scene, self.tr("opening of {name}").format(name=path.name))
        return True

    def ask_to_save_scene(self) -> None:
        """Let the user choose where to save the scene."""
        name, _ = QFileDialog.getSaveFileName(
            self._window, self.tr("Save scene"), self._in_folder("scene.toml"),
            self.tr("Scenes (*.toml)"),
        )  # fmt: skip
        if name:
            self.save_scene(Path(name))

    def save_scene(self, path: Path) -> None:
        """Write the scene to a file."""
        self._save(path, lambda: write_whole(path, self._store.scene.to_toml().encode("utf-8")))

    def ask_to_save_picture(self) -> None:
        """Let the user choose where to save the simulated picture."""
        name, _ = QFileDialog.getSaveFileName(
            self._window, self.tr("Save simulated picture"), self._in_folder("simulation.png"),
            self.tr("Pictures ({patterns})").format(patterns=_PICTURES),
        )  # fmt: skip
        if name:
            self.save_picture(Path(name))

    def save_picture(self, path: Path) -> None:
        """Write the picture on the screen to a file, at its full size."""
        if self._snapshot is None:
            self.said.emit(self.tr("There is no picture yet."))
            return
        image = self._snapshot.frame.image
        self._save(path, lambda: write_image(path, image))

    def _save(self, path: Path, write: Callable[[], None]) -> None:
        try:
            write()
        except OccError as error:
            self.said.emit(str(error))
            return
        self._memory.visit(path)
        self.said.emit(self.tr("Saved {name}").format(name=path.name))

    def _in_folder(self, name: str) -> str:
        folder = self._memory.folder
        return str(Path(folder, name)) if folder else name

    def _remember(self, photo: Photo | None) -> None:
        if photo is not None and photo.path not in sample_photos():
            self._memory.add(photo.path)
