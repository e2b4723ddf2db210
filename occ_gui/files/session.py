"""Session: writes what the user has set at most a second after every change, and restores it."""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.files.session_file import SessionFile
from occ_gui.files.session_record import Kept
from occ_model.errors import OccError

LONGEST_WAIT_MS = 1000
"""Longest time from a change to its writing; later changes within it are written with it."""


def restored(
    file: SessionFile, first: Workspace, *, is_scene_asked: bool, are_settings_asked: bool
) -> Workspace:
    """Return the workspace that a window begins with: that of the last session.

    ``first``: what the command line asks for. A scene or settings that it names win.
    """
    last = file.last
    if last is None:
        return first
    # Of a window that crashed comes all that is no step; its scene comes as one.
    workspace = last.workspace.step.laid_over((file.crashed or last).workspace)
    if is_scene_asked:
        workspace = replace(
            workspace, scene=first.scene, preset="", scene_file=None, photo=first.photo,
            film=first.film,
        )  # fmt: skip
    return replace(workspace, settings=first.settings) if are_settings_asked else workspace


class Session(QObject):
    """Keeps the workspace of a window in a file; before :meth:`begin` it writes nothing.

    ``own``: gives what the user has set, which is no lesson's.
    """

    status_message = Signal(str)
    """What has been restored, or why the session cannot be written; the latter is not repeated."""

    written = Signal()

    def __init__(self, store: Store, own: Callable[[], Workspace]) -> None:
        super().__init__()
        self._store, self._own = store, own
        self._file: SessionFile | None = None
        self._has_failed = False
        # Started by the first change only: if each change restarted it, it would never run out
        # while a slider keeps moving.
        self._timer = QTimer(self, singleShot=True)
        self._timer.setInterval(LONGEST_WAIT_MS)
        self._timer.timeout.connect(self.write)

    def begin(self, file: SessionFile, *, is_scene_asked: bool) -> None:
        """Bring back the steps of a crash, and write to the file from now on."""
        self._file = file
        if file.crashed is not None:
            self._bring_back(file.crashed, is_scene_asked=is_scene_asked)
        self._store.select(lambda workspace: workspace).changed.connect(self._note_change)
        self._note_change()

    def _bring_back(self, left: Kept, *, is_scene_asked: bool) -> None:
        """Put the scene of a crash with the steps that led to it, or as a step if it is old."""
        store, asked = self._store, self._store.workspace.step
        crashed = left.workspace.step
        store.put(crashed.laid_over(store.workspace), "restoring of the last session")
        if left.history is not None and (is_scene_asked or crashed == asked):
            store.resume(left.history)
        message = "The last session did not come to its end: its scene is restored."
        if is_scene_asked and crashed != asked:
            store.put(asked.laid_over(store.workspace), "opening of what was asked for")
            message = "The last session did not come to its end; Undo brings its scene back."
        self.status_message.emit(message)

    @property
    def is_due(self) -> bool:
        return self._timer.isActive()

    def _note_change(self) -> None:
        if self._file is not None and not self.is_due:
            self._timer.start()

    def write(self) -> None:
        own = self._own()
        self._write(Kept(own, self._store.history(own.step)), in_use=True)

    def end(self) -> None:
        self._write(Kept(self._own()), in_use=False)
        if self._file is not None:
            self._file.close()
            self._file = None

    def _write(self, kept: Kept, *, in_use: bool) -> None:
        self._timer.stop()
        if self._file is None:
            return
        try:
            self._file.write(kept, in_use)
        except OccError as error:
            if not self._has_failed:
                self._has_failed = True
                reason = str(error).rstrip(".")
                self.status_message.emit(f"The scene is not kept over a crash: {reason}.")
            return
        self._has_failed = False
        self.written.emit()
