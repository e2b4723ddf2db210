"""Full screen: the window without frame, as large as the screen, for a projector."""

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow


class FullScreen(QObject):
    """Connects the entry of the menu with the window's state, whoever changes it."""

    def __init__(self, window: QMainWindow, action: QAction) -> None:
        super().__init__(window)
        self._window, self._action = window, action
        action.setCheckable(True)
        action.toggled.connect(self._show)
        window.installEventFilter(self)

    def _show(self, full: bool) -> None:
        # One bit of the state only, so that a maximized window is one again afterwards.
        state = self._window.windowState()
        flag = Qt.WindowState.WindowFullScreen
        self._window.setWindowState(state | flag if full else state & ~flag)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if watched is self._window and event.type() == QEvent.Type.WindowStateChange:
            self._action.setChecked(self._window.isFullScreen())
        return False
