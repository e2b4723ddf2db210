"""Shows the welcome page, and leads through the door that the user chooses."""

from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.shell.feature import Service
from occ_gui.shell.shell import Shell
from occ_gui.welcome.welcome_dialog import WelcomeDialog
from occ_gui.window.main_window import MainWindow

_SEEN = "welcome/seen"
_MODES = {"learn": "lessons", "photo": "photo", "explore": "explore"}


class Welcome(Service):
    def __init__(
        self, window: MainWindow, shell: Shell, preferences: Preferences, files: FileController
    ) -> None:
        super().__init__()
        self._window, self._shell = window, shell
        self._preferences, self._files = preferences, files
        self.dialog: WelcomeDialog | None = None  # the page, while it is shown

    def show_once(self) -> None:
        """Show the page if it has never been shown to this user."""
        if self._preferences.recall(_SEEN) == "":
            self._preferences.keep(_SEEN, "yes")
            self.show()

    def show(self) -> None:
        if self.dialog is None:
            self.dialog = WelcomeDialog(self._window)
            self.dialog.chosen.connect(self.enter)
            self.dialog.finished.connect(self._forget)
        self.dialog.show()
        self.dialog.activateWindow()

    def enter(self, door: str) -> None:
        """Lay the window out for what is behind a door, and begin it."""
        self._window.modes.switch(_MODES[door])
        if door == "learn":
            self._window.bring_to_front("lessons")
            self._shell.pane("lessons").controller.begin_first()
        elif door == "photo":
            self._files.ask_for_photo()

    def _forget(self) -> None:
        self.dialog = None
