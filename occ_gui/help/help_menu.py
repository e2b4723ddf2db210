"""The entries of the menu Help that open the manual."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu

from occ_gui.help.pages import GUIDE, docs_folder

if TYPE_CHECKING:  # made when it is first asked for: the application starts so much sooner
    from occ_gui.help.help_window import HelpWindow


class HelpMenu(QObject):
    """Opens the manual: as a whole, or where it explains the current pane."""

    status_message = Signal(str)
    """Why the manual cannot be shown."""

    def __init__(
        self,
        window: QMainWindow,
        menu: QMenu,
        current_pane: Callable[[], str],
        pages: Mapping[str, str],
    ) -> None:
        super().__init__(window)
        self._window, self._current_pane = window, current_pane
        self.pages = pages
        self._help: HelpWindow | None = None
        self.guide = QAction("&User's guide", menu)
        self.pane = QAction("About this &pane", menu)
        self.pane.setShortcut(QKeySequence("Shift+F1"))
        self.guide.triggered.connect(lambda: self.show_page(GUIDE))
        self.pane.triggered.connect(self._show_pane)
        menu.insertActions(menu.actions()[0], [self.guide, self.pane])

    def _show_pane(self) -> None:
        self.show_page(self.pages.get(self._current_pane(), GUIDE))

    def show_page(self, page: str) -> None:
        """Open the manual at a page or heading, such as ``guide.md#heading``."""
        try:
            shown = self._window_of_manual()
        except OSError as error:
            self.status_message.emit(f"The manual cannot be read: {error.strerror}.")
            return
        shown.show()
        shown.show_page(page)
        shown.activateWindow()

    def _window_of_manual(self) -> "HelpWindow":
        if self._help is None:
            from occ_gui.help.help_window import HelpWindow

            self._help = HelpWindow(docs_folder(), self._window)
        return self._help
