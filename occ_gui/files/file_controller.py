"""File controller: the dialogs of the file menu; opens and saves scenes, photos and pictures."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.files.preferences import Preferences
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.present_results import ResultsConsumer
from occ_gui.simulation.snapshot import Snapshot
from occ_model.errors import OccError, one_line
from occ_model.files.reading import is_film
from occ_model.files.resources import resource_path
from occ_model.files.writing import PICTURE_ENDINGS, write_image, write_whole
from occ_model.scene.from_text import SCENE_ENDING, read_scene_file, write_scene_file
from occ_model.scene.provenance import ENDINGS, scene_inside

if TYPE_CHECKING:
    from occ_model.photo.reading.load import Photo


_PICTURES = " ".join(f"*{ending}" for ending in PICTURE_ENDINGS)
_FILMS = "*.mp4 *.mov *.m4v *.avi *.mkv *.webm *.gif *.png *.apng"
_RAW = "*.dng *.nef *.cr2 *.cr3 *.arw *.raf *.rw2 *.orf *.pef"
_PHOTOS = f"{_PICTURES} *.heic *.heif *.avif *.gif *.ppm *.pgm *.jp2 {_RAW}"
PHOTO_KINDS = f"Photos ({_PHOTOS});;All files (*)"


def _has_scene(path: Path) -> bool:
    """Return whether a file is a scene, or a figure or table that contains one."""
    ending = path.suffix.lower()
    if ending != ".png":  # which can also be a photo
        return ending == SCENE_ENDING or ending in ENDINGS
    try:
        scene_inside(path)
    except OccError:
        return False
    return True


def _is_file(path: Path) -> bool:
    """Return whether a path is a regular file; False for an invalid path."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def sample_photos() -> list[Path]:
    return sorted(resource_path("photos").glob("*.jpg"))


class FileController(QObject):
    """Carries out the commands of the file menu, and opens files dropped on the window.

    ``when_present`` calls a function with the results of the present scene once they are computed.
    """

    status_message = Signal(str)
    failed = Signal(str)  # why a file was not opened or saved
    scene_opened = Signal(Path)

    pane_requested = Signal(str)  # the pane of the photo or photos that were opened

    film_requested = Signal(Path)
    film_save_requested = Signal(Path)
    scene_saved = Signal(Path)

    def __init__(
        self,
        window: QWidget,
        scenes: SceneStore,
        photos: PhotoController,
        preferences: Preferences,
        when_present: Callable[[ResultsConsumer], None],
    ) -> None:
        super().__init__(window)
        self._window = window
        self._scenes = scenes
        self._photos = photos
        self._preferences = preferences
        self._when_present = when_present
        photos.opened.connect(self._add_to_recent)

    def ask_for_photo(self) -> None:
        """Ask for photos; open a single one, and list several as a table."""
        names, _ = QFileDialog.getOpenFileNames(
            self._window, "Open photos", self._preferences.folder, PHOTO_KINDS
        )
        if len(names) > 1:
            self.open_dropped([Path(name) for name in names])
        elif names:
            self.open_file(Path(names[0]))

    def ask_for_film(self) -> None:
        if path := self._ask_for_file("Open film", f"Films ({_FILMS})"):
            self.open_film(path)

    def open_film(self, path: Path) -> None:
        self._preferences.add(path)
        self.film_requested.emit(path)

    def ask_to_save_film(self) -> None:
        kinds = "Films (*.mkv *.mp4 *.gif *.png)"
        if path := self._ask_for_name("Save the simulated film", "film.mkv", kinds):
            self._preferences.remember_folder(path)
            self.film_save_requested.emit(path)

    def ask_for_scene(self) -> None:
        patterns = " ".join(f"*{ending}" for ending in (SCENE_ENDING, *ENDINGS))
        if path := self._ask_for_file("Open scene", f"Scenes and figures ({patterns})"):
            self.open_scene(path)

    def open_file(self, path: Path) -> None:
        """Open a scene file, an exported figure, a film or a photo."""
        if _has_scene(path):
            self.open_scene(path)
        elif is_film(path):
            self.open_film(path)
        else:
            self.open_photo(path)

    def open_photo(self, path: Path) -> None:
        self._photos.open(path)
        self.pane_requested.emit("photo")

    def open_recent(self, path: Path) -> None:
        """Open a recent file; remove it from the list if it no longer exists."""
        if _is_file(path):
            self.open_file(path)
            return
        self._preferences.drop(path)
        self.failed.emit(f"{one_line(str(path))} is no longer there.")

    def open_sample(self, path: Path) -> None:
        scene = path.with_suffix(SCENE_ENDING)
        if scene.is_file():
            self._put_scene(scene)
        self.open_photo(path)

    def open_dropped(self, paths: Sequence[Path]) -> None:
        """Open the first dropped scene, film and photo, or several photos as a table."""
        files = [path for path in paths if _is_file(path)]
        scenes = [path for path in files if _has_scene(path)]
        films = [path for path in files if path not in scenes and is_film(path)]
        photos = [path for path in files if path not in (*scenes, *films)]
        if not files:
            reason = f"{one_line(str(paths[0]))} is not a file" if paths else ""
            reason = reason or "What was dropped is not a file on this computer"
            self.failed.emit(f"{reason}; drop a photo, a film or a scene (.toml).")
            return
        for path in scenes[:1]:
            self.open_scene(path)
        for path in photos[:1]:
            self.open_photo(path)
        for path in films[:1]:
            self.open_film(path)
        if len(photos) > 1:
            self._photos.list_files(photos)
            self.pane_requested.emit("photos")
        opened = (*scenes[:1], *photos[:1], *films[:1])
        names = [one_line(path.name) for path in opened]
        if len(paths) > len(scenes[:1]) + len(photos) + len(films[:1]):
            self.status_message.emit(
                f"{len(paths)} items were dropped; only {' and '.join(names)} can be shown."
            )

    def open_scene(self, path: Path) -> None:
        if self._put_scene(path):
            self._preferences.add(path)
            is_scene = path.suffix.lower() == SCENE_ENDING
            if is_scene:  # a figure or table does not become the file of the scene
                self.scene_opened.emit(path)
            inside = "" if is_scene else "the scene inside "
            self.status_message.emit(f"Opened {inside}{one_line(path.name)}")

    def _put_scene(self, path: Path) -> bool:
        try:
            scene = read_scene_file(path)
        except OccError as error:
            self.failed.emit(str(error))
            return False
        title = f"opening of {one_line(path.name)}"
        self._scenes.begin(scene, title)
        return True

    def ask_to_save_scene(self) -> None:
        if path := self._ask_for_name("Save scene", "scene.occ.toml", "Scenes (*.toml)"):
            self.save_scene(path)

    def save_scene(self, path: Path) -> None:
        scene = self._scenes.scene
        if self._save(path, lambda: write_scene_file(path, scene)):
            self._preferences.add(path)
            self.scene_saved.emit(path)

    def ask_to_save_picture(self) -> None:
        picture_kind = self._scenes.store.workspace.picture_kind
        title, kinds = f"Save the {picture_kind}'s picture", f"Pictures ({_PICTURES})"
        if path := self._ask_for_name(title, f"simulation-{picture_kind}.png", kinds):
            self.save_picture(path)

    def ask_to_save_table(self, text: str) -> None:
        if path := self._ask_for_name(
            "Save the table of the photos", "readout.csv", "Tables (*.csv)"
        ):
            self._save(path, lambda: write_whole(path, text.encode("utf-8")))

    def save_picture(self, path: Path) -> None:
        """Save the picture of the present scene at full size, the camera's or the receiver's."""
        self._when_present(
            partial(self._write_picture, path, self._scenes.store.workspace.picture_kind)
        )

    def _write_picture(self, path: Path, picture_kind: str, snapshot: Snapshot) -> None:
        frame = snapshot.frame
        image, title = frame.picture(picture_kind), frame.picture_title(picture_kind)
        title_in_sentence = f"{title[:1].lower()}{title[1:]}"
        self._save(path, lambda: write_image(path, image, title), title_in_sentence)

    def _save(self, path: Path, write: Callable[[], None], content: str = "") -> bool:
        try:
            write()
        except OccError as error:
            self.failed.emit(str(error))
            return False
        self._preferences.remember_folder(path)
        self.status_message.emit(
            f"Saved {one_line(path.name)}{f': the {content}' if content else ''}"
        )
        return True

    def _ask_for_file(self, title: str, kinds: str) -> Path | None:
        folder = self._preferences.folder
        name, _ = QFileDialog.getOpenFileName(
            self._window, title, folder, f"{kinds};;All files (*)"
        )
        return Path(name) if name else None

    def _ask_for_name(self, title: str, first: str, kinds: str) -> Path | None:
        """Ask for a file name to save to; a name without an ending gets the ending of ``first``."""
        folder = self._preferences.folder
        start = str(Path(folder, first)) if folder else first
        name, _ = QFileDialog.getSaveFileName(self._window, title, start, kinds)
        if not name:
            return None
        if (path := Path(name)).suffix:
            return path
        path = path.with_suffix(Path(first).suffix)
        if path.exists():  # the dialog asked only about the name without the ending
            self.failed.emit(
                f"{one_line(path.name)} exists already: to replace it, type its name with the "
                "ending."
            )
            return None
        return path

    def _add_to_recent(self, photo: "Photo | None") -> None:
        if photo is not None and photo.path not in sample_photos():
            self._preferences.add(photo.path)
