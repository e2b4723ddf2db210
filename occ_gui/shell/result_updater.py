"""ResultUpdater: keeps one of the results up to date with a task."""

from collections import deque
from collections.abc import Callable
from typing import Generic

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Request, Result, Task
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.results import Results, ResultsStore


class ResultUpdater(QObject, Generic[Request, Result]):
    """Recomputes a result whenever the workspace, or a result that it depends on, changes.

    ``of`` returns the request for the task, or None if there is nothing to compute. ``put`` stores
    or removes the result. ``stays``: whether the last result stays until the next one is ready.
    ``keep``: number of earlier results that are kept for requests that are made again.
    """

    begun = Signal()

    ended = Signal()  # the request was met, has failed, or is no longer needed
    found = Signal(object)  # a result of the task, after it was stored
    failed = Signal(str)  # a sentence that says why there is no result

    def __init__(
        self,
        store: Store,
        results_store: ResultsStore,
        task: Task[Request, Result],
        of: Callable[[Workspace, Results], Request | None],
        put: Callable[[Results, Result | None], Results],
        *,
        stays: bool = False,
        keep: int = 0,
    ) -> None:
        super().__init__()
        self._store, self._results_store, self.task = store, results_store, task
        self._of, self._put, self._stays = of, put, stays
        self._request: Request | None = None
        self._kept: deque[tuple[Request, Result]] = deque(maxlen=keep)
        task.finished.connect(self._take)
        task.failed.connect(self._fail)
        store.select(lambda workspace: workspace).changed.connect(self.update)
        results_store.changed.connect(self.update)
        self.update()

    def update(self) -> None:
        request = self._of(self._store.workspace, self._results_store.results)
        if request == self._request:
            return
        self._request = request
        if not self.task.is_idle:
            self.task.cancel()
            self.ended.emit()
        kept = next((result for asked, result in self._kept if asked == request), None)
        if request is not None and kept is None:
            self.task.ask(request)
            self.begun.emit()
        if not self._stays or request is None or kept is not None:
            self._results_store.put(self._put(self._results_store.results, kept))

    def keep(self, result: Result) -> None:
        """Keep a result of the present request in place of the previous one."""
        if self._request is not None:
            others = [(asked, other) for asked, other in self._kept if asked != self._request]
            self._kept = deque([*others, (self._request, result)], self._kept.maxlen)

    def _take(self, result: Result) -> None:
        self.keep(result)
        self.ended.emit()
        self._results_store.put(self._put(self._results_store.results, result))
        self.found.emit(result)

    def _fail(self, sentence: str) -> None:
        self.ended.emit()
        self.failed.emit(sentence)
