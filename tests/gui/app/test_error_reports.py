"""Unhandled errors and full disks: the window works on, reports them, and keeps the work."""

import sys
import threading
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from gui.pane_bench import PaneBench
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.exceptions import capture_exceptions
from pytestqt.qtbot import QtBot

from occ_gui.app.error_reports import ErrorReports
from occ_gui.decoding.bit_strip import BitStrip
from occ_gui.decoding.feature import decoding
from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.picture.feature import picture
from occ_gui.widgets.guarded_paint import guarded
from occ_model.scene.scene import Scene

STILL_THERE = "Your work is still there."


@pytest.fixture
def said() -> list[str]:
    """List what is reported."""
    return []


@pytest.fixture
def reports(qapp: QApplication, said: list[str]) -> Iterator[ErrorReports]:
    """Take all exceptions, in place of the tests' own hook."""
    reports = ErrorReports()
    reports.reported.connect(said.append)
    with capture_exceptions():
        reports.install()
        yield reports
        reports.remove()


def test_a_sentence_names_the_mistake_and_not_what_it_passed_through(
    reports: ErrorReports, said: list[str]
) -> None:
    passed = "Error calling Python override of QObject::eventFilter(): " * 2
    reports.report(ZeroDivisionError, ZeroDivisionError(f"{passed}a mistake"), None)
    assert "Something went wrong: ZeroDivisionError: a mistake." in said[-1]


def broken(*_arguments: object, **_named: object) -> None:
    raise ZeroDivisionError("a mistake")


def test_the_report_of_an_exception_is_one_line(reports: ErrorReports, said: list[str]) -> None:
    reports.report(ValueError, ValueError("two\nlines\x1b" + "x" * 5000), None)
    (message,) = said
    assert message.isprintable()
    assert len(message) < 400


def test_a_repeated_exception_is_reported_once(reports: ErrorReports, said: list[str]) -> None:
    for _ in range(50):
        try:
            broken()
        except ZeroDivisionError as error:
            sys.excepthook(type(error), error, error.__traceback__)
    assert len(said) == 1


def test_an_exception_in_a_thread_is_a_sentence(
    reports: ErrorReports, said: list[str], qtbot: QtBot
) -> None:
    thread = threading.Thread(target=broken)
    thread.start()
    thread.join()
    qtbot.waitUntil(lambda: bool(said))
    assert STILL_THERE in said[-1]


@pytest.mark.parametrize(
    ("painted", "fails"), [(AveragedImage, "_averaged"), (BitStrip, "_draw_bit")]
)
def test_an_exception_while_something_is_painted_is_a_sentence(
    qtbot: QtBot, small_scene: Scene, reports: ErrorReports, said: list[str],
    monkeypatch: pytest.MonkeyPatch, painted: type, fails: str,
) -> None:  # fmt: skip
    bench = PaneBench(qtbot, small_scene)
    image = bench.add(picture(bench.store, str)).view
    bench.add(decoding(bench.store))
    with monkeypatch.context() as patched:
        patched.setattr(painted, fails, broken)
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


def test_painting_goes_on_after_a_guarded_exception(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[object] = []
    monkeypatch.setattr(sys, "excepthook", lambda kind, error, trace: seen.append(kind))
    guarded(broken)()
    assert seen == [ZeroDivisionError]


def test_the_previous_hook_is_restored_when_the_window_closes(qtbot: QtBot) -> None:
    before = (sys.excepthook, threading.excepthook)
    reports = ErrorReports()
    reports.install()
    reports.remove()
    assert (sys.excepthook, threading.excepthook) == before


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
