"""Start of a window: its scene and settings, from the command line or the last session."""

import os
from argparse import Namespace
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from occ_gui.core.workspace import Workspace
from occ_gui.values.choices import PhotoChoice
from occ_model.errors import OccError
from occ_model.files.writing import make_folder, make_private
from occ_model.scene.scene import Scene, SimulationSettings

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings

    from occ_gui.app.application import Application
    from occ_gui.files.session import SessionFile


_NAMES = ("occ-explorer", "occ-gui")
"""Organisation and application under which Qt stores the settings by default."""


class DefaultOption(str):
    """The default of an option, distinguishable from the same value given by the user."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Start:
    workspace: Workspace  # that of the command line, or of the last session
    # Whether the command line names a scene, which takes precedence over the last session's
    names_scene: bool
    preferences: "QSettings | None" = None  # the stored preferences; None if nothing is stored
    # The file of this window's session; None if nothing is stored
    session_file: "SessionFile | None" = None
    is_fresh: bool = False  # whether nothing of the last session is to be restored

    @property
    def is_new(self) -> bool:
        """Whether neither the command line nor an earlier session determines what to show."""
        has_session = self.session_file is not None and self.session_file.last is not None
        return not self.names_scene and (self.is_fresh or not has_session)

    @property
    def first_workspace(self) -> Workspace:
        """The workspace with which a window is made; the rest follows once it is connected."""
        workspace = Workspace(self.workspace.scene, self.workspace.settings)
        return self.workspace.undo_state.put_into(workspace)

    def restore(self, application: "Application", with_photo: bool) -> None:
        """Restore the session in a window before it is shown, and store it from now on."""
        if self.session_file is None:
            return
        application.error_reports.install()
        photo = self.workspace.photo if with_photo else PhotoChoice()
        application.resume(replace(self.workspace, photo=photo))
        if not self.is_fresh:
            application.options.restore()
        names_scene = self.names_scene or self.is_fresh
        application.session.begin(self.session_file, names_scene=names_scene)


def start_of(
    options: Namespace, scene: Scene, settings: SimulationSettings, has_settings: bool
) -> Start:
    """Return what a window starts with.

    ``has_settings``: whether the command line changes settings of the simulation.
    """
    is_default_preset = isinstance(options.preset, DefaultOption)
    names_scene = not is_default_preset or bool(options.scene or options.settings)
    first = Workspace(scene, settings)
    if options.screenshot:  # it does not depend on the last session
        return Start(first, names_scene, is_fresh=True)
    from occ_gui.files.session import SessionFile, restore_workspace, state_folder

    file = SessionFile(state_folder())
    if not options.fresh:
        first = restore_workspace(file, first, names_scene=names_scene, has_settings=has_settings)
    return Start(first, names_scene, open_preferences(), file, options.fresh)


def open_preferences() -> "QSettings":
    """Open the stored preferences, in the folder that the environment names or in Qt's.

    Only the user can read their file, which contains paths of photos; Qt keeps its permissions.
    """
    from PySide6.QtCore import QSettings

    from occ_gui.files.session import STATE_FOLDER, state_folder

    settings = QSettings(*_NAMES)
    if os.environ.get(STATE_FOLDER):
        settings = QSettings(str(state_folder() / "settings.ini"), QSettings.Format.IniFormat)
    path = Path(settings.fileName())
    if path.suffix in (".ini", ".conf"):  # not the registry of Windows, nor the lists of macOS
        with suppress(OccError, OSError):
            make_folder(path.parent, is_private=True)
            path.touch(mode=0o600)
            make_private(path)
    return settings
