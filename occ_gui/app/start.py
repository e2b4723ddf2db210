"""What a start takes up of the last one: settings, session, and where they are kept."""

import os
from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from occ_model.effects.registry import NAMES
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings

    from occ_gui.app.application import Application
    from occ_gui.files.session import Session


_NAMES = ("occ-explorer", "occ-gui")
"""Under which the settings are kept where nothing else is asked for."""


class DefaultOption(str):
    """What an option is where nobody has said anything: its default, and known as such."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Start:
    """What a window begins with.

    Parameters
    ----------
    scene, settings
        The scene, and how it is simulated at first.
    scene_asked
        Whether the scene was named, and wins over the last session's.
    memory
        Where things are kept; None where nothing is.
    session
        The last session.
    fresh
        Whether nothing of it is wanted.
    """

    scene: Scene
    settings: SimulationSettings
    scene_asked: bool
    memory: "QSettings | None"
    session: "Session"
    fresh: bool

    def restore(self, application: "Application", with_photo: bool) -> None:
        """Take up the session in a window that is not shown yet, and keep it from now on."""
        if self.memory is None:
            return
        application.desktop.error_reports.install()
        from occ_gui.files.autosave import Autosave, state_folder

        wins = self.scene_asked or self.fresh
        autosave = Autosave(state_folder())
        application.desktop.resume(autosave, self.session, wins, self.fresh)
        if with_photo and not wins and self.session.photo is not None:
            application.open_photo(self.session.photo, front=False)


def start_of(options: Namespace, scene: Scene, settings: SimulationSettings, own: bool) -> Start:
    """Decide what the window begins with.

    Parameters
    ----------
    options
        The command line.
    scene, settings
        What it asks for.
    own
        Whether the settings are those that hold where it asks for none.
    """
    from occ_gui.files.preferences import Memory
    from occ_gui.files.session import Session, recall_session

    asked = bool(options.scene or options.settings or not isinstance(options.preset, DefaultOption))
    if options.screenshot:  # of the window as it comes, whatever its user did last
        return Start(scene, settings, asked, None, Session(), fresh=True)
    memory = kept_settings()
    session = Session() if options.fresh else recall_session(Memory(memory), NAMES)
    if session.scene is not None and not asked:
        scene = session.scene
    if session.settings is not None and own:
        settings = session.settings
    return Start(scene, settings, asked, memory, session, options.fresh)


def kept_settings() -> "QSettings":
    """Open what is remembered from one start to the next."""
    from PySide6.QtCore import QSettings, QStandardPaths

    from occ_gui.files.autosave import STATE_FOLDER, state_folder
    from occ_gui.files.kept_file import is_something_else

    is_named = bool(os.environ.get(STATE_FOLDER))
    if is_named:
        path = state_folder() / "settings.ini"
    else:
        place = QStandardPaths.StandardLocation.GenericConfigLocation
        path = Path(QStandardPaths.writableLocation(place), *_NAMES).with_suffix(".conf")
    if is_something_else(path):  # which Qt would read, and wait: another one beside it
        return QSettings(str(path.with_stem(f"{path.stem}-new")), QSettings.Format.IniFormat)
    return QSettings(str(path), QSettings.Format.IniFormat) if is_named else QSettings(*_NAMES)
