"""Start of a window: its scene and settings, from the command line or the last session."""

import os
from argparse import Namespace
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from occ_model.effects.registry import NAMES
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings

    from occ_gui.app.application import Application
    from occ_gui.files.session import SessionFile
    from occ_gui.files.session_record import Session


_NAMES = ("occ-explorer", "occ-gui")
"""Organisation and application under which Qt stores the settings by default."""


class DefaultOption(str):
    """The default of an option, distinguishable from the same value given by the user."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Start:
    """What a window starts with.

    Parameters
    ----------
    scene, settings
        The first scene and the settings of its simulation.
    scene_asked
        Whether the command line names a scene, which takes precedence over the last session's.
    preferences
        The stored preferences; None where nothing is stored.
    session
        The last session.
    session_file
        The file of this window's session; None where nothing is stored.
    fresh
        Whether nothing of the last session is to be restored.
    """

    scene: Scene
    settings: SimulationSettings
    scene_asked: bool
    preferences: "QSettings | None"
    session: "Session"
    session_file: "SessionFile | None"
    fresh: bool

    @property
    def is_new(self) -> bool:
        """Whether neither the command line nor an earlier session says what to show."""
        return not self.scene_asked and self.session.scene is None

    def restore(self, application: "Application", with_photo: bool) -> None:
        """Restore the session in a window before it is shown, and store it from now on."""
        if self.session_file is None:
            return
        application.error_reports.install()
        wins = self.scene_asked or self.fresh
        application.kept.resume(self.session_file, self.session, wins, self.fresh)
        store = application.store.store
        if not wins:
            store.put(replace(store.workspace, film=self.session.film))
        if with_photo and not wins:
            application.photo.resume(self.session.photo)


def start_of(options: Namespace, scene: Scene, settings: SimulationSettings, own: bool) -> Start:
    """Determine what the window starts with.

    Parameters
    ----------
    options
        The command line.
    scene, settings
        The scene and the settings that follow from it.
    own
        Whether the settings are the defaults, as the command line names none.
    """
    from occ_gui.files.session import SessionFile, state_folder
    from occ_gui.files.session_record import Session

    asked = bool(options.scene or options.settings or not isinstance(options.preset, DefaultOption))
    if options.screenshot:  # it does not depend on the last session
        return Start(scene, settings, asked, None, Session(), None, fresh=True)
    preferences = kept_settings()
    session_file = SessionFile(state_folder(), NAMES)
    session = Session() if options.fresh else session_file.last
    if session.scene is not None and not asked:
        scene = session.scene
    if session.settings is not None and own:
        settings = session.settings
    return Start(scene, settings, asked, preferences, session, session_file, options.fresh)


def kept_settings() -> "QSettings | None":
    """Open the stored preferences; None if no file can store them, as Qt would block on each."""
    from PySide6.QtCore import QSettings, QStandardPaths

    from occ_gui.files.kept_file import is_something_else, usable_settings_path
    from occ_gui.files.session import STATE_FOLDER, state_folder

    is_named = bool(os.environ.get(STATE_FOLDER))
    if is_named:
        preferred = state_folder() / "settings.ini"
    else:
        place = QStandardPaths.StandardLocation.GenericConfigLocation
        preferred = Path(QStandardPaths.writableLocation(place), *_NAMES).with_suffix(".conf")
    path = usable_settings_path(preferred)
    if path is None:
        return None
    shared = preferred.parent.with_suffix(".conf")  # Qt reads the organisation's file as well
    if is_named or path != preferred or is_something_else(shared):
        return QSettings(str(path), QSettings.Format.IniFormat)
    return QSettings(*_NAMES)
