"""Unhandled errors and full disks: the window works on, reports them, and keeps the work."""

import logging
import sys
import threading
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from gui.kinds import add_widget
from gui.pane_bench import PaneBench
from PySide6.QtCore import qCritical, qDebug, qInstallMessageHandler, qWarning
from PySide6.QtGui import QGuiApplication, QPainter
from PySide6.QtWidgets import QApplication, QDialog, QLabel, QPlainTextEdit, QPushButton, QWidget
from pytestqt.exceptions import capture_exceptions
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.error_reports import HARMLESS_MESSAGE, ErrorReports, log_qt_messages
from occ_gui.app.panes import picture
from occ_gui.app.report import report_text, show_report
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

STILL_THERE = "Your work is still there."


@pytest.fixture
def said() -> list[str]:
    return []


@pytest.fixture
def reports(qapp: QApplication, said: list[str]) -> Iterator[ErrorReports]:
    """Take all exceptions, in place of the tests' own hook."""
    reports = ErrorReports()
    reports.reported.connect(said.append)
    before = (sys.excepthook, threading.excepthook)
    with capture_exceptions():
        reports.install()
        yield reports
        reports.remove()
    assert (sys.excepthook, threading.excepthook) == before


def test_a_sentence_of_one_line_names_the_mistake_and_not_what_it_passed_through(
    reports: ErrorReports, said: list[str]
) -> None:
    passed = "Error calling Python override of QObject::eventFilter(): " * 2
    reports.report(ZeroDivisionError, ZeroDivisionError(f"{passed}a mistake"), None)
    assert "Something went wrong: ZeroDivisionError: a mistake." in said[-1]
    reports.report(ValueError, ValueError("two\nlines\x1b" + "x" * 5000), None)
    message = said[-1]
    assert message.isprintable()
    assert len(message) < 400


def broken(*_arguments: object, **_named: object) -> None:
    raise ZeroDivisionError("a mistake")


def test_a_repeated_exception_is_reported_once(reports: ErrorReports, said: list[str]) -> None:
    for _ in range(50):
        try:
            broken()
        except ZeroDivisionError as error:
            sys.excepthook(type(error), error, error.__traceback__)
    assert len(said) == 1
    logging.getLogger("occ_gui").warning("the lamp is %s", "off")
    logging.getLogger("occ_gui").debug("and this is not wanted")
    assert reports.last.lines[-1].endswith("the lamp is off")


def test_an_exception_in_a_thread_is_a_sentence(
    reports: ErrorReports, said: list[str], qtbot: QtBot
) -> None:
    thread = threading.Thread(target=broken)
    thread.start()
    thread.join()
    qtbot.waitUntil(lambda: bool(said))
    assert STILL_THERE in said[-1]


def test_an_exception_while_something_is_painted_is_a_sentence_and_it_is_painted_the_next_time(
    qtbot: QtBot, small_scene: Scene, reports: ErrorReports, said: list[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    bench = PaneBench(qtbot, small_scene)
    image = bench.add(picture(bench.store, str)).view
    with monkeypatch.context() as patched:
        patched.setattr(QPainter, "drawImage", broken)
        bench.simulate()
        QApplication.processEvents()
        image.simulation.fit()
        bench.window.grab()
        assert STILL_THERE in said[-1]
    bench.window.grab()
    assert len(said) == 1


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


@pytest.fixture
def logged(caplog: pytest.LogCaptureFixture) -> Iterator[pytest.LogCaptureFixture]:
    """Log Qt's messages during one test; the handler of the test run is put back after it."""
    before = qInstallMessageHandler(None)
    log_qt_messages()
    with caplog.at_level(logging.DEBUG, logger="qt"):
        yield caplog
    qInstallMessageHandler(before)


def test_a_message_keeps_its_level_and_its_words(logged: pytest.LogCaptureFixture) -> None:
    given_up: list[str] = []
    log_qt_messages(lambda: given_up.append("by no message that is not fatal"))  # type: ignore[arg-type,return-value]
    qDebug("a detail")
    qWarning(HARMLESS_MESSAGE)  # a platform's note on every window
    qWarning("an odd thing")
    qCritical("a bad thing")
    assert logged.record_tuples == [
        ("qt", logging.DEBUG, "a detail"),
        ("qt", logging.DEBUG, HARMLESS_MESSAGE),
        ("qt", logging.WARNING, "an odd thing"),
        ("qt", logging.ERROR, "a bad thing"),
    ]
    assert given_up == []


def test_it_has_the_version_and_the_scene_and_hides_the_users_folder() -> None:
    scene = occ.load_preset("phone-68us")
    text = report_text(scene, SimulationSettings(), [])
    assert occ.__version__ in text
    assert occ.Scene.from_toml(text.partition("Scene:\n")[2]) == scene
    text = report_text(Scene(), SimulationSettings(), [f'File "{Path.home() / "a.py"}", line 3'])
    assert str(Path.home()) not in text
    assert "~" in text


def test_it_is_shown_and_copied(qtbot: QtBot) -> None:
    window = add_widget(qtbot, QWidget())
    shown = report_text(Scene().replace(iso=456.0), SimulationSettings(), [])
    assert "iso = 456" in shown
    show_report(window, shown)
    (dialog,) = window.findChildren(QDialog)
    (field,) = dialog.findChildren(QPlainTextEdit)
    assert field.toPlainText() == shown
    (copy,) = [b for b in dialog.findChildren(QPushButton) if b.text() == "&Copy"]
    copy.click()
    assert QGuiApplication.clipboard().text() == shown
    assert any(label.text().startswith("Copied: ") for label in dialog.findChildren(QLabel))
    dialog.reject()
