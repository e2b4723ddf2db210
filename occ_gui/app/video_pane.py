"""Films in the window: opened when their pane is first shown."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject

from occ_gui.core.store import Store
from occ_gui.shell.shell import Shell
from occ_gui.window.main_window import MainWindow

if TYPE_CHECKING:
    from occ_gui.video.wiring import VideoWiring


class VideoPane(QObject):
    """What opens, saves and closes films; a film is opened at the first look at its pane.

    ``ask_for_film`` lets the user choose a film, ``ask_to_save`` where to write the simulated one.
    """

    def __init__(
        self,
        window: MainWindow,
        shell: Shell,
        store: Store,
        ask_for_film: Callable[[], None],
        ask_to_save: Callable[[], None],
    ) -> None:
        super().__init__()
        self._window, self._shell, self._store = window, shell, store
        self._ask_for_film, self._ask_to_save = ask_for_film, ask_to_save
        shell.made.connect(self._connect)
        store.select(lambda workspace: workspace.film.path).changed.connect(self._on_film)

    def _connect(self, name: str, pane: Any) -> None:
        if name != "video":
            return
        pane.open_asked.connect(self._ask_for_film)
        pane.save_asked.connect(self._ask_to_save)

    @property
    def wiring(self) -> "VideoWiring":
        """The pane, which is made if it has never been seen."""
        pane: VideoWiring = self._shell.pane("video")
        return pane

    @property
    def _made(self) -> "VideoWiring | None":
        pane: VideoWiring | None = self._shell.made_pane("video")
        return pane

    @property
    def path(self) -> Path | None:
        """The film that is open, or will be when the pane is first shown."""
        return self._store.workspace.film.path

    def open(self, path: Path) -> None:
        if self._made is None:
            workspace = self._store.workspace
            self._store.put(replace(workspace, film=workspace.film.opened(path)))
        else:
            self._made.open(path)
        self._window.bring_to_front("video")

    def save(self, path: Path) -> None:
        self.wiring.save(path)

    def close(self) -> None:
        if self._made is None:
            workspace = self._store.workspace
            self._store.put(replace(workspace, film=workspace.film.opened(None)))
        else:
            self._made.close()

    def _on_film(self, path: Path | None) -> None:
        self._window.actions_by_name["close_film"].setEnabled(path is not None)
