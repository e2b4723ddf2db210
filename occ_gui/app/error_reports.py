"""Error reports: unhandled exceptions and Qt's messages go to the log and the status line."""

import logging
import re
import sys
import threading
from collections import deque
from collections.abc import Callable
from types import TracebackType
from typing import NoReturn

from PySide6.QtCore import QMessageLogContext, QObject, QtMsgType, Signal, qInstallMessageHandler

from occ_model.errors import one_line

_log = logging.getLogger(__name__)
_qt_log = logging.getLogger("qt")

_MOST_LINES = 60  # number of kept lines of messages

_LEVELS = {
    QtMsgType.QtDebugMsg: logging.DEBUG,
    QtMsgType.QtInfoMsg: logging.INFO,
    QtMsgType.QtWarningMsg: logging.WARNING,
    QtMsgType.QtCriticalMsg: logging.ERROR,
    QtMsgType.QtFatalMsg: logging.CRITICAL,
}

HARMLESS_MESSAGE = "This plugin does not support propagateSizeHints()"
"""Qt's message for every window on a platform that has no windows."""


_PREFIX = re.compile(r"(Error calling Python override of [\w:]+\(\): )+")
"""Prefix of Qt for Python to the text of an exception that was raised in an event handler."""


class LastMessages(logging.Handler):
    """Keeps the last log messages for the error report."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.setFormatter(logging.Formatter("%(asctime)s %(name)s %(levelname)s %(message)s"))
        self.lines: deque[str] = deque(maxlen=_MOST_LINES)

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.extend(self.format(record).splitlines())
        if logging.lastResort is not None:  # print it, as Python does without handlers
            logging.lastResort.handle(record)


class ErrorReports(QObject):
    """Logs every unhandled exception, and reports it once for each line that raises it."""

    reported = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.last_messages = LastMessages()
        self._reported_errors: set[tuple[str, str, int]] = set()
        self._previous_hooks: tuple[Callable[..., object], Callable[..., object]] | None = None

    def install(self) -> None:
        self._previous_hooks = (sys.excepthook, threading.excepthook)
        sys.excepthook = self.report
        logging.getLogger().addHandler(self.last_messages)
        threading.excepthook = self._report_thread

    def remove(self) -> None:
        if self._previous_hooks is not None:
            sys.excepthook, threading.excepthook = self._previous_hooks
            logging.getLogger().removeHandler(self.last_messages)
            self._previous_hooks = None

    def report(
        self, kind: type[BaseException], error: BaseException, trace: TracebackType | None
    ) -> None:
        """Log an exception, and report it unless one of its kind was reported at this line."""
        if issubclass(kind, KeyboardInterrupt | SystemExit):
            sys.__excepthook__(kind, error, trace)
            return
        key = (kind.__name__, *_find_line(trace))
        if key in self._reported_errors:
            return
        self._reported_errors.add(key)
        _log.error("unhandled", exc_info=(kind, error, trace))
        text = _PREFIX.sub("", str(error))
        reason = one_line(f"{kind.__name__}: {text}".rstrip(": ."))
        self.reported.emit(f"Something went wrong: {reason}. Your work is not lost.")

    def _report_thread(self, args: threading.ExceptHookArgs) -> None:
        error = args.exc_value
        if error is not None:
            self.report(args.exc_type, error, args.exc_traceback)


def _find_line(trace: TracebackType | None) -> tuple[str, int]:
    if trace is None:
        return "", 0
    while trace.tb_next is not None:
        trace = trace.tb_next
    return trace.tb_frame.f_code.co_filename, trace.tb_lineno


def log_qt_messages(give_up: Callable[[], NoReturn] | None = None) -> None:
    """Send Qt's messages to the logger ``qt``.

    ``give_up``: ends the process after a fatal message, in place of Qt, which would write a core
    dump. It must not raise: an exception cannot pass through Qt.
    """

    def log(kind: QtMsgType, _context: QMessageLogContext, message: str) -> None:
        if kind == QtMsgType.QtFatalMsg and give_up is not None:
            give_up()
        _qt_log.log(logging.DEBUG if message == HARMLESS_MESSAGE else _LEVELS[kind], message)

    qInstallMessageHandler(log)
