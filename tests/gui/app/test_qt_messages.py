"""Qt's messages go to Python's logging, each at its own level."""

import logging
from collections.abc import Iterator

import pytest
from PySide6.QtCore import qCritical, qDebug, qInstallMessageHandler, qWarning

from occ_gui.app.error_reports import HARMLESS, log_qt_messages


@pytest.fixture
def logged(caplog: pytest.LogCaptureFixture) -> Iterator[pytest.LogCaptureFixture]:
    """Log Qt's messages during one test; the handler of the test run is put back after it."""
    before = qInstallMessageHandler(None)
    log_qt_messages()
    with caplog.at_level(logging.DEBUG, logger="qt"):
        yield caplog
    qInstallMessageHandler(before)


def test_a_message_keeps_its_level_and_its_words(logged: pytest.LogCaptureFixture) -> None:
    qDebug("a detail")
    qWarning("an odd thing")
    qCritical("a bad thing")
    assert logged.record_tuples == [
        ("qt", logging.DEBUG, "a detail"),
        ("qt", logging.WARNING, "an odd thing"),
        ("qt", logging.ERROR, "a bad thing"),
    ]


def test_a_platforms_note_on_every_window_is_no_warning(logged: pytest.LogCaptureFixture) -> None:
    qWarning(HARMLESS)
    assert [level for _, level, _ in logged.record_tuples] == [logging.DEBUG]


def test_the_tests_overlook_that_message_and_no_other(pytestconfig: pytest.Config) -> None:
    (overlooked,) = pytestconfig.getini("qt_log_ignore")
    assert len(overlooked) > 20
    assert HARMLESS.startswith(overlooked)
