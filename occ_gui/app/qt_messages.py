"""Qt's own messages, into Python's logging."""

import logging
from collections.abc import Callable
from typing import NoReturn

from PySide6.QtCore import QMessageLogContext, QtMsgType, qInstallMessageHandler

_log = logging.getLogger("qt")

_LEVELS = {
    QtMsgType.QtDebugMsg: logging.DEBUG,
    QtMsgType.QtInfoMsg: logging.INFO,
    QtMsgType.QtWarningMsg: logging.WARNING,
    QtMsgType.QtCriticalMsg: logging.ERROR,
    QtMsgType.QtFatalMsg: logging.CRITICAL,
}

HARMLESS = "This plugin does not support propagateSizeHints()"
"""What a platform without windows says of every window."""


def log_qt_messages(give_up: Callable[[], NoReturn] | None = None) -> None:
    """Send what Qt has to say to the logger ``qt``.

    Parameters
    ----------
    give_up
        Ends the process in place of Qt, which would leave a core dump. It must not raise: an
        exception cannot pass through Qt.
    """

    def log(kind: QtMsgType, _context: QMessageLogContext, message: str) -> None:
        if kind == QtMsgType.QtFatalMsg and give_up is not None:
            give_up()
        _log.log(logging.DEBUG if message == HARMLESS else _LEVELS[kind], message)

    qInstallMessageHandler(log)
