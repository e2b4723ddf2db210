"""Screenshot of the window, once it shows all that was requested."""

from pathlib import Path

from PySide6.QtCore import QBuffer, QDeadlineTimer, QEventLoop, QIODevice, QTimer
from PySide6.QtWidgets import QApplication

import occ_model as occ
from occ_gui.app.application import Application
from occ_model.errors import one_line
from occ_model.files.writing import write_whole

_PATIENCE_MS = 60_000  # longest time that a screenshot waits for the picture


def wait_until_shown(application: Application, measured: bool = False) -> None:
    """Process events until all requested results are shown.

    ``measured``: whether to wait for the detection map and the strips under the sliders, too; a map
    may stay incomplete. Raises OccError where the scene has no picture, or it takes too long.
    """
    failures: list[str] = []
    photo = application.shell.find_pane("photo")
    matching = () if photo is None else (photo.matching,)
    for controller in (application.simulation, application.photos, *matching):
        controller.failed.connect(failures.append)
    deadline = QDeadlineTimer(_PATIENCE_MS)
    QTimer.singleShot(_PATIENCE_MS, application.window.update)  # ends the wait for events
    QApplication.processEvents()  # work that is about to start makes the application busy
    while not (is_done := _is_idle(application, measured)) and not deadline.hasExpired():
        # Wait instead of polling: the worker needs the interpreter.
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        if _is_idle(application, measured):
            QApplication.processEvents()  # paints, which may start more work
    if failures:
        raise occ.OccError(failures[0])
    # A map may stay incomplete: one of whole pictures takes minutes, and shows its progress.
    if not (is_done or _is_idle(application, measured=False)):
        raise occ.OccError(f"There was no picture after {_PATIENCE_MS // 1000} s.")


def _is_idle(application: Application, measured: bool) -> bool:
    return application.is_idle and (application.is_measured or not measured)


def take_screenshot(application: Application, path: Path) -> None:
    try:
        wait_until_shown(application, measured=True)
        buffer = QBuffer()
        buffer.open(QIODevice.OpenModeFlag.WriteOnly)
        if not application.window.grab().save(buffer, "PNG"):
            raise occ.OutputError(
                f"{one_line(str(path))} cannot be written: the window cannot be drawn."
            )
    finally:
        application.window.close()
    write_whole(path, bytes(buffer.data().data()))
