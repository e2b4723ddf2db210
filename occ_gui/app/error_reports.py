"""Mistakes of ours: into the log and the status line, and the window lives on."""

import logging
import sys
import threading
from collections.abc import Callable
from types import TracebackType

from PySide6.QtCore import QObject, Signal

_log = logging.getLogger(__name__)


class Faults(QObject):
    """Takes every exception that nobody has handled.

    One that comes again from the same line, as at every drawing of a pane, is told of only once.
    """

    happened = Signal(str)
    """What happened, in a sentence."""

    def __init__(self) -> None:
        super().__init__()
        self._told: set[tuple[str, str, int]] = set()
        self._before: tuple[Callable[..., object], Callable[..., object]] | None = None

    def install(self) -> None:
        """Take the exceptions of all threads from now on."""
        self._before = (sys.excepthook, threading.excepthook)
        sys.excepthook = self.take
        threading.excepthook = self._take_of_thread

    def remove(self) -> None:
        """Leave the exceptions to whoever took them before."""
        if self._before is not None:
            sys.excepthook, threading.excepthook = self._before
            self._before = None

    def take(
        self, kind: type[BaseException], error: BaseException, trace: TracebackType | None
    ) -> None:
        """Log an exception, and tell of it."""
        if issubclass(kind, KeyboardInterrupt | SystemExit):
            sys.__excepthook__(kind, error, trace)
            return
        place = _place(trace)
        key = (kind.__name__, *place)
        if key in self._told:
            return
        self._told.add(key)
        _log.error("unhandled", exc_info=(kind, error, trace))
        reason = f"{kind.__name__}: {error}".rstrip(": .")
        self.happened.emit(
            self.tr("Something went wrong: {reason}. Your work is still there.").format(
                reason=reason
            )
        )

    def _take_of_thread(self, args: threading.ExceptHookArgs) -> None:
        error = args.exc_value
        if error is not None:
            self.take(args.exc_type, error, args.exc_traceback)


def _place(trace: TracebackType | None) -> tuple[str, int]:
    """Give the file and line where an exception was raised."""
    if trace is None:
        return "", 0
    while trace.tb_next is not None:
        trace = trace.tb_next
    return trace.tb_frame.f_code.co_filename, trace.tb_lineno
