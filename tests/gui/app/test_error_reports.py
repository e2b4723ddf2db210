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
from occ_model.scene.scene import Scene, SimulationSettings

STILL_THERE = "Your work is not lost."


@pytest.fixture
def sentences() -> list[str]:
    return []


@pytest.fixture
def reports(qapp: QApplication, sentences: list[str]) -> Iterator[ErrorReports]:
    """Handle all exceptions instead of the tests' own hook."""
    reports = ErrorReports()
    reports.reported.connect(sentences.append)
    before = (sys.excepthook, threading.excepthook)
    with capture_exceptions():
        reports.install()
        yield reports
        reports.remove()
    assert (sys.excepthook, threading.excepthook) == before


def test_a_sentence_of_one_line_names_the_error_without_qts_prefix(
    reports: ErrorReports, sentences: list[str]
) -> None:
    prefix = "Error calling Python override of QObject::eventFilter(): " * 2
    reports.report(ZeroDivisionError, ZeroDivisionError(f"{prefix}a mistake"), None)
    assert "Something went wrong: ZeroDivisionError: a mistake." in sentences[-1]
    reports.report(ValueError, ValueError("two\nlines\x1b" + "x" * 5000), None)
    message = sentences[-1]
    assert message.isprintable()
    assert len(message) < 400


def fail(*_arguments: object, **_options: object) -> None:
    raise ZeroDivisionError("a mistake")


def test_a_repeated_exception_is_reported_once(reports: ErrorReports, sentences: list[str]) -> None:
    for _ in range(50):
        try:
            fail()
        except ZeroDivisionError as error:
            sys.excepthook(type(error), error, error.__traceback__)
    assert len(sentences) == 1
    logging.getLogger("occ_gui").warning("the lamp is %s", "off")
    logging.getLogger("occ_gui").debug("and this is not wanted")
    assert reports.last_messages.lines[-1].endswith("the lamp is off")


def test_an_exception_in_a_thread_is_a_sentence(
    reports: ErrorReports, sentences: list[str], qtbot: QtBot
) -> None:
    thread = threading.Thread(target=fail)
    thread.start()
    thread.join()
    qtbot.waitUntil(lambda: bool(sentences))
    assert STILL_THERE in sentences[-1]


def test_an_exception_while_painting_is_reported_and_the_next_painting_works(
    qtbot: QtBot, small_scene: Scene, reports: ErrorReports, sentences: list[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    bench = PaneBench(qtbot, small_scene)
    image = bench.add(picture(bench.store, str)).view
    with monkeypatch.context() as patched:
        patched.setattr(QPainter, "drawImage", fail)
        bench.simulate()
        QApplication.processEvents()
        image.simulation.fit()
        bench.window.grab()
        assert STILL_THERE in sentences[-1]
    bench.window.grab()
    assert len(sentences) == 1


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
def qt_log(caplog: pytest.LogCaptureFixture) -> Iterator[pytest.LogCaptureFixture]:
    """Log Qt's messages during one test, and restore the handler of the test run."""
    before = qInstallMessageHandler(None)
    log_qt_messages()
    with caplog.at_level(logging.DEBUG, logger="qt"):
        yield caplog
    qInstallMessageHandler(before)


def test_a_message_keeps_its_level_and_text(qt_log: pytest.LogCaptureFixture) -> None:
    ends: list[str] = []
    log_qt_messages(lambda: ends.append("only after a fatal message"))
    qDebug("a detail")
    qWarning(HARMLESS_MESSAGE)  # a platform's note on every window
    qWarning("an odd thing")
    qCritical("a bad thing")
    assert qt_log.record_tuples == [
        ("qt", logging.DEBUG, "a detail"),
        ("qt", logging.DEBUG, HARMLESS_MESSAGE),
        ("qt", logging.WARNING, "an odd thing"),
        ("qt", logging.ERROR, "a bad thing"),
    ]
    assert ends == []


def test_the_report_has_version_and_scene_and_hides_the_users_folder() -> None:
    scene = occ.load_preset("phone-68us")
    text = report_text(scene, SimulationSettings(), [])
    assert occ.__version__ in text
    assert occ.Scene.from_toml(text.partition("Scene:\n")[2]) == scene
    text = report_text(Scene(), SimulationSettings(), [f'File "{Path.home() / "a.py"}", line 3'])
    assert str(Path.home()) not in text
    assert "~" in text


def test_the_report_is_shown_and_copied(qtbot: QtBot) -> None:
    window = add_widget(qtbot, QWidget())
    text = report_text(Scene().replace(iso=456.0), SimulationSettings(), [])
    assert "iso = 456" in text
    show_report(window, text)
    (dialog,) = window.findChildren(QDialog)
    (field,) = dialog.findChildren(QPlainTextEdit)
    assert field.toPlainText() == text
    (copy,) = [b for b in dialog.findChildren(QPushButton) if b.text() == "&Copy"]
    copy.click()
    assert QGuiApplication.clipboard().text() == text
    assert any(label.text().startswith("Copied: ") for label in dialog.findChildren(QLabel))
    dialog.reject()
