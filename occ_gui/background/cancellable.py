"""One piece of work off the window's thread that tells how far it is, and can be cancelled."""

from collections.abc import Callable
from typing import Any, Generic, TypeAlias, TypeVar

from PySide6.QtCore import Signal

from occ_gui.background.single_run import SingleRun

Request = TypeVar("Request")
Result = TypeVar("Result")

Progress: TypeAlias = Callable[[float], None]
"""Takes the share of the work that is done, from 0 to 1; ends the work by raising."""


class Cancellable(SingleRun, Generic[Request, Result]):
    """Runs a function on a thread of its own, and ends it at its next step if it is cancelled.

    Parameters
    ----------
    work
        The function: a request and whom to tell of progress in, a result out. It must not touch
        a widget.
    name
        What it is, for the thread's name and the log.
    """

    progressed = Signal(float)
    """The share of the work that is done, from 0 to 1."""

    finished = Signal(object)
    """The result."""

    def __init__(self, work: Callable[[Request, Progress], Result], name: str) -> None:
        def tell_begun(request: Request, progress: Progress) -> Result:
            progress(0.0)
            return work(request, progress)

        super().__init__(tell_begun, name)

    def _take(self, told: Any) -> None:
        self.progressed.emit(told)

    def _succeed(self, result: Any) -> None:
        self.finished.emit(result)
