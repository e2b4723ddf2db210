"""The welcome page, declared."""

from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.shell.feature import Feature, Service
from occ_gui.shell.shell import Shell
from occ_gui.window.main_window import MainWindow


def welcome(
    window: MainWindow, shell: Shell, preferences: Preferences, files: FileController
) -> Feature[None]:
    """Declare the page, whose doors lead to lessons, photo and exploring."""

    def make() -> Service:
        from occ_gui.welcome.welcome import Welcome

        return Welcome(window, shell, preferences, files)

    return Feature(name="welcome", make=make, commands={"welcome": lambda page: page.show()})
