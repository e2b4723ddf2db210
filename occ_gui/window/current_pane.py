"""Current pane: the one that has the focus or whose tab was selected last."""

from collections.abc import Mapping

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QWidget

PICTURE = "picture"


class CurrentPane(QObject):
    def __init__(self, window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
        super().__init__(window)
        self._window = window
        self._docks = docks
        self.name = PICTURE
        for name, dock in docks.items():
            dock.visibilityChanged.connect(lambda seen, name=name: self._on_seen(name, seen))
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.connect(self._on_focus)

    def _on_seen(self, name: str, seen: bool) -> None:
        # When the window is first shown all docks become visible without the user's choosing one.
        tabbed = self._window.tabifiedDockWidgets(self._docks[name])
        if seen and tabbed and self._window.isActiveWindow():
            self.name = name

    def _on_focus(self, _before: QWidget | None, now: QWidget | None) -> None:
        if now is None or now.window() is not self._window:
            return
        middle = self._window.centralWidget()
        if middle is not None and (now is middle or middle.isAncestorOf(now)):
            self.name = PICTURE
        for name, dock in self._docks.items():
            if dock.isAncestorOf(now):
                self.name = name
