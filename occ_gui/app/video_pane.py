"""Pane of the films: made when it is first shown, with the film that was to be opened."""

from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QWidget

from occ_gui.scene.scene_store import SceneStore
from occ_gui.widgets.lazy_pane import LazyPane, PaneContent

if TYPE_CHECKING:
    from occ_gui.video.wiring import VideoWiring


class DockWindow(Protocol):
    """A window that panes can be added to."""

    @property
    def actions_by_name(self) -> Mapping[str, QAction]:
        """The menu entries, by name."""

    def add_pane(self, name: str, title: str, content: QWidget) -> QDockWidget:
        """Add a pane before the window is shown."""

    def bring_to_front(self, name: str) -> None:
        """Show a pane in front of those that share its place."""


class VideoPane(QObject):
    """The dock of the films; nothing of them is loaded before it is first shown.

    Parameters
    ----------
    window
        The window that the dock is added to.
    scenes
        The store of the scene.
    ask_for_film
        Lets the user choose a film.
    ask_to_save
        Lets the user choose where to write the simulated film.
    """

    status_message = Signal(str)
    """The outcome of an action."""

    film_changed = Signal(object)
    """The path of the film that is open now, None where none is."""

    def __init__(
        self,
        window: DockWindow,
        scenes: SceneStore,
        ask_for_film: Callable[[], None],
        ask_to_save: Callable[[], None],
    ) -> None:
        super().__init__()
        self._window, self._scenes = window, scenes
        self._ask_for_film, self._ask_to_save = ask_for_film, ask_to_save
        self._later: Path | None = None
        pane = LazyPane(self._make)
        dock = window.add_pane("video", self.tr("Video"), pane)
        dock.visibilityChanged.connect(pane.set_seen)
        window.actions_by_name["open_film"].triggered.connect(ask_for_film)
        window.actions_by_name["close_film"].triggered.connect(self.close)

    @cached_property
    def wiring(self) -> "VideoWiring":
        """The pane with its controllers."""
        from occ_gui.video.wiring import VideoWiring

        wiring = VideoWiring(self._scenes)
        wiring.open_asked.connect(self._ask_for_film)
        wiring.save_asked.connect(self._ask_to_save)
        wiring.status_message.connect(self.status_message)
        wiring.film_changed.connect(self._on_film)
        return wiring

    def _make(self) -> PaneContent:
        wiring = self.wiring
        if self._later is not None:
            wiring.open(self._later)
            self._later = None
        return wiring.view, wiring.set_seen

    @property
    def path(self) -> Path | None:
        """The film that is open, or will be when the pane is first shown."""
        return self.wiring.path if "wiring" in vars(self) else self._later

    def open(self, path: Path) -> None:
        """Open a film in front."""
        self.keep(path)
        self._window.bring_to_front("video")

    def keep(self, path: Path) -> None:
        """Open a film, as soon as the pane is shown."""
        if "wiring" in vars(self):
            self.wiring.open(path)
        else:
            self._later = path

    def save(self, path: Path) -> None:
        """Write the simulated film to a file."""
        self.wiring.save(path)

    def close(self) -> None:
        """Close the film."""
        if "wiring" in vars(self):
            self.wiring.close()

    def _on_film(self, path: Path | None) -> None:
        self._window.actions_by_name["close_film"].setEnabled(path is not None)
        self.film_changed.emit(path)

    @property
    def is_idle(self) -> bool:
        """Whether the frame is shown and the film read."""
        return "wiring" not in vars(self) or self.wiring.is_idle

    def stop(self) -> None:
        """Stop all work in the background, and release the camera."""
        if "wiring" in vars(self):
            self.wiring.stop()
