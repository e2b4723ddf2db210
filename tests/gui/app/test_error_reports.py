"""Unhandled errors and full disks: the window works on, reports them, and keeps the work."""

import logging
import sys
import threading
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from gui.user import User
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.exceptions import capture_exceptions
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.app.error_reports import ErrorReports
from occ_gui.decoding.bit_strip import BitStrip
from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.widgets.guarded_paint import guarded

pytestmark = pytest.mark.own_window

STILL_THERE = "Your work is still there."


@pytest.fixture
def reports(application: Application) -> Iterator[ErrorReports]:
    """Let the window take all exceptions, in place of the tests' own hook."""
    reports = application.error_reports
    with capture_exceptions():
        reports.install()
        yield reports
        reports.remove()


def works(application: Application, user: User) -> bool:
    user.enter("iso", "456")
    return application.store.scene.camera.iso == 456.0 and not user.message


def test_a_sentence_names_the_mistake_and_not_what_it_passed_through(
    application: Application, user: User, reports: ErrorReports
) -> None:
    passed = "Error calling Python override of QObject::eventFilter(): " * 2
    reports.report(ZeroDivisionError, ZeroDivisionError(f"{passed}a mistake"), None)
    assert "Something went wrong: ZeroDivisionError: a mistake." in user.message


def broken(*_arguments: object, **_named: object) -> None:
    raise ZeroDivisionError("a mistake")


def test_an_exception_in_a_slot_is_a_sentence_and_in_the_log(
    application: Application, user: User, reports: ErrorReports, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.ERROR):
        QTimer.singleShot(0, broken)
        QApplication.processEvents()
        QApplication.processEvents()
    assert "ZeroDivisionError: a mistake" in user.message
    assert STILL_THERE in user.message
    assert "Traceback" in caplog.text
    application.window.statusBar().clearMessage()
    assert works(application, user)


def test_the_report_of_an_exception_is_one_line(reports: ErrorReports) -> None:
    messages: list[str] = []
    reports.reported.connect(messages.append)
    reports.report(ValueError, ValueError("two\nlines\x1b" + "x" * 5000), None)
    (message,) = messages
    assert message.isprintable()
    assert len(message) < 400


def test_a_repeated_exception_is_reported_once(reports: ErrorReports) -> None:
    messages: list[str] = []
    reports.reported.connect(messages.append)
    for _ in range(50):
        try:
            broken()
        except ZeroDivisionError as error:
            sys.excepthook(type(error), error, error.__traceback__)
    assert len(messages) == 1


def test_an_exception_in_a_thread_is_a_sentence(
    application: Application, user: User, reports: ErrorReports, qtbot: QtBot
) -> None:
    thread = threading.Thread(target=broken)
    thread.start()
    thread.join()
    qtbot.waitUntil(lambda: STILL_THERE in user.message)
    application.window.statusBar().clearMessage()
    assert works(application, user)


def test_an_exception_in_the_simulation_keeps_the_last_picture(
    application: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = application.view("picture").simulation.level_at(10, 10)
    with monkeypatch.context() as patched:
        patched.setattr("occ_gui.simulation.controller.render_with", broken)
        application.store.change(iso=333.0)
        user.wait_until_idle()
        assert user.message == "The simulation failed: ZeroDivisionError: a mistake."
    assert application.store.scene.camera.iso == 333.0
    assert application.view("picture").simulation.level_at(10, 10) == shown
    assert works(application, user)


def test_an_exception_while_a_picture_is_painted_is_a_sentence(
    application: Application, user: User, reports: ErrorReports, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patched:
        patched.setattr(AveragedImage, "_averaged", broken)
        application.story.show_whole_picture(True)
        application.view("picture").simulation.fit()
        application.store.change(iso=222.0)
        user.wait_until_idle()
        application.window.grab()
        assert STILL_THERE in user.message
    application.window.statusBar().clearMessage()
    assert works(application, user)
    application.window.grab()


def test_an_exception_while_a_widget_is_painted_is_a_sentence(
    application: Application, user: User, reports: ErrorReports, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patched:
        patched.setattr(BitStrip, "_draw_bit", broken)
        application.window.bring_to_front("decode")
        application.view("decode").grab()
        assert STILL_THERE in user.message
    application.window.grab()


def test_all_our_own_painting_is_guarded() -> None:
    package = Path(sys.modules["occ_gui"].__file__ or "").parent
    unguarded = []
    for path in package.rglob("*.py"):
        lines = path.read_text(encoding="utf-8").splitlines()
        for before, line in pairwise(lines):
            is_paint = line.strip().startswith(("def paint(", "def paintEvent("))
            if is_paint and before.strip() != "@guarded":
                unguarded.append(f"{path.name}: {line.strip()}")
    assert unguarded == []


def test_painting_goes_on_after_a_guarded_exception(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[object] = []
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: seen.append(kind))
    guarded(broken)()
    assert seen == [ZeroDivisionError]


def test_the_previous_hook_is_restored_when_the_window_closes(
    qtbot: QtBot,
) -> None:
    before = (sys.excepthook, threading.excepthook)
    reports = ErrorReports()
    reports.install()
    reports.remove()
    assert (sys.excepthook, threading.excepthook) == before


@pytest.mark.parametrize("content", ["format = 99\n", "format = 'new'\n[camera]\nlens = 3\n"])
def test_a_scene_file_of_a_newer_version_is_refused(
    application: Application, user: User, tmp_path: Path, content: str
) -> None:
    path = tmp_path / "newer.toml"
    path.write_text(content, encoding="utf-8")
    before = application.store.scene
    application.files.open_scene(path)
    assert "this version reads format 1" in user.message
    assert application.store.scene == before
    application.window.statusBar().clearMessage()
    assert works(application, user)


def test_a_full_disk_while_saving_keeps_the_old_file_and_says_so(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "scene.toml"
    application.files.save_scene(path)
    old = path.read_bytes()
    user.enter("distance", "2 m")
    assert application.window.isWindowModified()
    write = Path.write_bytes

    def full(place: Path, content: bytes) -> int:
        write(place, content[:9])
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_bytes", full)
        application.window.actions_by_name["save_scene"].trigger()
        assert "No space left on device" in user.message
    assert path.read_bytes() == old
    assert list(tmp_path.iterdir()) == [path]
    assert application.window.isWindowModified()
    application.window.actions_by_name["save_scene"].trigger()
    assert not application.window.isWindowModified()
    assert path.read_bytes() != old


def test_a_widget_that_fails_once_is_drawn_the_next_time(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[bool] = []
    monkeypatch.setattr(sys, "excepthook", lambda *_: None)

    class Fragile(QWidget):
        @guarded
        def paintEvent(self, _event: object) -> None:  # noqa: N802 - Qt's name
            drawn.append(True)
            if len(drawn) == 1:
                broken()

    widget = Fragile()
    qtbot.addWidget(widget)
    widget.grab()
    widget.grab()
    assert len(drawn) == 2
