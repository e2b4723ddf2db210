"""Films in the window: opens, saves and closes them."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject

from occ_gui.core.store import Store
from occ_gui.files.file_controller import FileController
from occ_gui.shell.shell import Shell
from occ_gui.window.main_window import MainWindow

if TYPE_CHECKING:
    from occ_gui.video.wiring import VideoWiring


class VideoPane(QObject):
    """Opens, saves and closes films; a film is read when its pane is first shown."""

    def __init__(
        self, window: MainWindow, shell: Shell, store: Store, files: FileController
    ) -> None:
        super().__init__()
        self._window, self._shell, self._store, self._files = window, shell, store, files
        shell.made.connect(self._connect)
        files.film_asked.connect(self.open)
        files.film_save_asked.connect(self.save)

    def _connect(self, name: str, pane: Any) -> None:
        if name == "video":
            pane.open_asked.connect(self._files.ask_for_film)
            pane.save_asked.connect(self._files.ask_to_save_film)

    @property
    def wiring(self) -> "VideoWiring":
        pane: VideoWiring = self._shell.pane("video")
        return pane

    def open(self, path: Path) -> None:
        if self._shell.find_pane("video") is None:
            self._choose(path)
        else:
            self.wiring.open(path)
        self._window.bring_to_front("video")

    def save(self, path: Path) -> None:
        self.wiring.save(path)

    def close(self) -> None:
        if self._shell.find_pane("video") is None:
            self._choose(None)
        else:
            self.wiring.close()

    def _choose(self, path: Path | None) -> None:
        workspace = self._store.workspace
        self._store.put(replace(workspace, film=workspace.film.open(path)))
