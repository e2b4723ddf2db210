"""Lessons in the window: shows the panes that their steps need, and carries out their actions."""

from typing import Any

from PySide6.QtCore import QObject, Signal

from occ_gui.core.workspace import Workspace
from occ_gui.shell.shell import Shell
from occ_gui.window.main_window import MainWindow

_ENTRY_OF_ACTION = {"transmitter": "transmitter", "photo": "open_photo", "match": "match"}
"""Menu entries of the lessons' buttons."""


class LessonsInWindow(QObject):
    noted = Signal(str)  # the outcome of an action, shown until the scene changes

    columns_held = Signal(object)
    """Number of columns that a lesson keeps in view; None for the usual number."""

    photo_explained = Signal(bool)  # whether the lesson's present step is about the photo

    def __init__(self, window: MainWindow, shell: Shell) -> None:
        super().__init__()
        self._window, self._shell = window, shell
        self._opened_pane = ""  # the pane that a step has opened; empty for none
        shell.made.connect(self._connect)

    def _connect(self, name: str, pane: Any) -> None:
        if name != "lessons":
            return
        pane.noted.connect(self.noted)
        lessons = pane.controller
        lessons.pane_requested.connect(self._show_pane_of_step)
        lessons.columns_held.connect(self.columns_held)
        lessons.action_requested.connect(self._carry_out)

    def _carry_out(self, action: str) -> None:
        self._window.actions_by_name[_ENTRY_OF_ACTION[action]].trigger()

    def _show_pane_of_step(self, name: str) -> None:
        if self._opened_pane not in {"", name}:  # the screen may be too small for both
            self._window.hide_pane(self._opened_pane)
            self._opened_pane = ""
        if name:
            dock = self._window.docks[name]
            is_new = dock.isHidden()
            self._window.bring_into_view(name)
            if is_new and not dock.isHidden():
                self._opened_pane = name
        self.photo_explained.emit(name == "photo")

    def user_workspace(self) -> Workspace | None:
        pane = self._shell.find_pane("lessons")
        workspace: Workspace | None = None if pane is None else pane.controller.user_workspace()
        return workspace

    def end(self) -> None:
        """Restore the user's own work, if a lesson is under way."""
        pane = self._shell.find_pane("lessons")
        if pane is not None:
            pane.end()
