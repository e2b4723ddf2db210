"""Work off the window's thread whose results come one by one, and which can be cancelled."""

from collections.abc import Callable, Iterator
from typing import Any, Generic, TypeVar

from PySide6.QtCore import Signal

from occ_gui.background.single_run import SingleRun

Request = TypeVar("Request")
Item = TypeVar("Item")


class Progressive(SingleRun, Generic[Request, Item]):
    """Runs an iterator on a thread of its own and hands over its items as they come.

    A cancelled run ends after the item that it is at.

    Parameters
    ----------
    work
        Gives the iterator for a request. Neither may touch a widget.
    name
        What it is, for the thread's name and the log.
    """

    item = Signal(object)
    """The next item of the run."""

    finished = Signal()
    """All items of the run have arrived."""

    def __init__(self, work: Callable[[Request], Iterator[Item]], name: str) -> None:
        def tell_all(request: Request, tell: Callable[[Item], None]) -> None:
            for item in work(request):
                tell(item)

        super().__init__(tell_all, name)

    def _take(self, told: Any) -> None:
        self.item.emit(told)

    def _succeed(self, _result: Any) -> None:
        self.finished.emit()
