"""Shows the welcome page, and leads through the door that the user chooses."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

if TYPE_CHECKING:
    from occ_gui.app.application import Application
    from occ_gui.welcome.welcome_dialog import WelcomeDialog

_SEEN = "welcome/seen"
_MODES = {"learn": "lessons", "photo": "photo", "explore": "explore"}


class Welcome(QObject):
    """The welcome page of an application.

    Parameters
    ----------
    application
        The application.
    """

    def __init__(self, application: "Application") -> None:
        super().__init__(application)
        self._application = application
        self.dialog: WelcomeDialog | None = None
        """The page, while it is shown."""
        application.window.actions_by_name["welcome"].triggered.connect(self.show)

    def show_once(self) -> None:
        """Show the page if it has never been shown to this user."""
        preferences = self._application.preferences
        if preferences.recall(_SEEN) == "":
            preferences.keep(_SEEN, "yes")
            self.show()

    def show(self) -> None:
        """Show the page in front of the window."""
        # Made when it is wanted, not with the program.
        from occ_gui.welcome.welcome_dialog import WelcomeDialog

        if self.dialog is None:
            self.dialog = WelcomeDialog(self._application.window)
            self.dialog.chosen.connect(self.enter)
            self.dialog.finished.connect(self._forget)
        self.dialog.show()
        self.dialog.activateWindow()

    def enter(self, door: str) -> None:
        """Lay the window out for what is behind a door, and begin it."""
        application = self._application
        application.window.modes.switch(_MODES[door])
        if door == "learn":
            application.window.bring_to_front("lessons")
            application.shell.pane("lessons").controller.begin_first()
        elif door == "photo":
            application.files.ask_for_photo()

    def _forget(self) -> None:
        self.dialog = None
