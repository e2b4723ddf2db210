"""The manual: opened as a whole, or where it explains the current pane."""

from collections.abc import Callable, Mapping

from PySide6.QtWidgets import QMainWindow

from occ_gui.help.help_window import HelpWindow
from occ_gui.help.pages import GUIDE, docs_folder
from occ_gui.shell.feature import Service


class Manual(Service):
    """The window of the manual, made when a page is first shown.

    ``pages`` has page and heading of each pane, of which ``current_pane`` gives one.
    """

    def __init__(
        self, window: QMainWindow, current_pane: Callable[[], str], pages: Mapping[str, str]
    ) -> None:
        super().__init__()
        self._window, self._current_pane, self.pages = window, current_pane, pages
        self._help: HelpWindow | None = None

    def show_pane(self) -> None:
        self.show_page(self.pages.get(self._current_pane(), GUIDE))

    def show_page(self, page: str = GUIDE) -> None:
        """Open the manual at a page or heading, such as ``guide.md#heading``."""
        try:
            if self._help is None:
                self._help = HelpWindow(docs_folder(), self._window)
        except OSError as error:
            self.status_message.emit(f"The manual cannot be read: {error.strerror}.")
            return
        self._help.show()
        self._help.show_page(page)
        self._help.activateWindow()
