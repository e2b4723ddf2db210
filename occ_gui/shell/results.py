"""Results computed for the workspace, their updates, and the sentence of the status line."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Request, Result, Task
from occ_gui.core.store import Selection, Store
from occ_gui.core.workspace import Workspace
from occ_gui.simulation.snapshot import Picture, Reading, Snapshot
from occ_gui.values.remarks import Failure, Remark
from occ_gui.values.simulated import SimulationRequest
from occ_model.results.frame import Decision

if TYPE_CHECKING:  # a window without a photo or film starts without them
    from occ_gui.values.photo_results import (
        ListedRows,
        PhotoDocument,
        PhotoProfile,
        StripeSearch,
    )
    from occ_model.photo.reading.load import Photo
    from occ_model.results.chip_reading import ChipReading
    from occ_model.results.match import Match
    from occ_model.results.video import Video


T = TypeVar("T")


@dataclass(frozen=True, eq=False, slots=True)
class Results:
    """The latest results; each part holds the request that it was computed from."""

    remark: Remark | None = None  # the latest remark for the status line

    failure: Failure | None = None  # why the present scene has no picture

    snapshot: Snapshot | None = None  # the exact picture, and what is read from it

    picture: Picture | None = None
    """The first picture: a draft, or the exact one before it is decoded."""

    reading: Reading | None = None
    """The reading of the picture, or of the profile before there is a picture."""

    before: Snapshot | None = None  # the exact picture before the latest step
    switched: tuple[Decision, ...] = ()  # the effects that the plan has just switched in or out
    document: "PhotoDocument | None" = None
    """The photo that was loaded last; another one may be loading."""

    stripes: "StripeSearch | None" = None  # stripes of the photo, or of the part that is matched

    chips: "ChipReading | None" = None

    listed: "ListedRows | None" = None  # what was found in the photos of the table

    photo_profile: "PhotoProfile | None" = None
    """The profile of the open photo, in the columns of the simulated one."""

    film: "Video | None" = None  # the film that was last opened from a file

    @property
    def photo(self) -> "Photo | None":
        return None if self.document is None else self.document.photo

    @property
    def match(self) -> "Match | None":
        """The match of the open photo."""
        outcome = None if self.document is None else self.document.outcome
        return None if outcome is None else outcome.match

    @property
    def code_chips(self) -> "ChipReading | None":
        """The chips that were read from the photo, unless its match is of a lamp, without any."""
        match = self.match
        return self.chips if match is None or match.lamp is None else None


MadeOf: TypeAlias = Callable[[Results], SimulationRequest | None]
"""Returns what a part of the results was computed from; None if there is none."""


def of_snapshot(results: Results) -> SimulationRequest | None:
    return None if results.snapshot is None else results.snapshot.request


def of_reading(results: Results) -> SimulationRequest | None:
    """Return what the reading was computed from; it is ready before the exact picture."""
    return None if results.reading is None else results.reading.request


def of_picture(results: Results) -> SimulationRequest | None:
    return None if results.picture is None else results.picture.request


class ResultsStore(QObject):
    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.results = Results()
        self._selections: list[Selection[Any]] = []

    def select(self, find: Callable[[Results], T]) -> Selection[T]:
        """Return a selection of the results; its listeners are called after the panes."""
        selection = Selection(find, self.results)
        self._selections.append(selection)
        return selection

    def put(self, results: Results) -> None:
        self.results = results
        self.changed.emit()
        for selection in self._selections:
            value = selection.find(self.results)
            if value is not selection.value:
                selection.value = value
                selection.changed.emit(value)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self.put(replace(self.results, snapshot=snapshot, failure=None))

    def show_picture(self, picture: Picture) -> None:
        self.put(replace(self.results, picture=picture))

    def show_reading(self, reading: Reading) -> None:
        self.put(replace(self.results, reading=reading))

    def show_before(self, snapshot: Snapshot) -> None:
        self.put(replace(self.results, before=snapshot))

    def show_switched(self, switched: tuple[Decision, ...]) -> None:
        self.put(replace(self.results, switched=switched))


StateSelector: TypeAlias = Callable[[Workspace, Results], object]
"""Returns the part of the state that a sentence is about: it holds until that part changes."""


def next_sentence(_workspace: Workspace, _results: Results) -> object:
    return None


def entries_of(workspace: Workspace) -> tuple[object, ...]:
    """Return what the user enters: the scene, the settings, and values entered in single panes."""
    film = workspace.film
    fields = (workspace.room, film.recording, film.frames, workspace.frame_rate)
    return (workspace.scene, workspace.settings, *fields)


def next_change(workspace: Workspace, _results: Results) -> object:
    return entries_of(workspace)


def next_picture(_workspace: Workspace, results: Results) -> object:
    return results.snapshot


def next_photo(_workspace: Workspace, results: Results) -> object:
    return results.photo


def next_match(_workspace: Workspace, results: Results) -> object:
    document = results.document
    return None if document is None else (document.photo, document.outcome)


def make_remark(
    sentence: str, select_state: StateSelector, workspace: Workspace, results: Results
) -> Remark:
    return Remark(sentence, select_state, select_state(workspace, results))


def status_message(workspace: Workspace, results: Results) -> str:
    """Return the sentence of the status line; empty if the last one no longer holds."""
    remark = results.remark
    if remark is None or remark.select_state(workspace, results) != remark.state:
        return ""
    return remark.sentence


class ResultUpdater(QObject, Generic[Request, Result]):
    """Recomputes a result whenever the workspace, or a result that it depends on, changes.

    ``find_request`` returns the request for the task, or None if there is nothing to compute.
    ``put`` stores or removes the result. ``stays``: whether the last result stays until the next
    one is ready.
    ``keep``: number of earlier results that are cached for requests made again.
    """

    begun = Signal()

    ended = Signal()  # the request was fulfilled, has failed, or is no longer needed
    failed = Signal(str)  # a sentence that says why there is no result

    def __init__(
        self,
        store: Store,
        results_store: ResultsStore,
        task: Task[Request, Result],
        find_request: Callable[[Workspace, Results], Request | None],
        put: Callable[[Results, Result | None], Results],
        *,
        stays: bool = False,
        keep: int = 0,
    ) -> None:
        super().__init__()
        self._store, self._results_store, self.task = store, results_store, task
        self._find_request, self._put, self._stays = find_request, put, stays
        self._request: Request | None = None
        self._cache: deque[tuple[Request, Result]] = deque(maxlen=keep)
        task.finished.connect(self._take)
        task.failed.connect(self._fail)
        store.select(lambda workspace: workspace).changed.connect(self.update)
        results_store.changed.connect(self.update)
        self.update()

    def update(self) -> None:
        request = self._find_request(self._store.workspace, self._results_store.results)
        if request == self._request:
            return
        self._request = request
        if not self.task.is_idle:
            self.task.cancel()
            self.ended.emit()
        cached = next((result for earlier, result in self._cache if earlier == request), None)
        if request is not None and cached is None:
            self.task.ask(request)
            self.begun.emit()
        if not self._stays or request is None or cached is not None:
            self._results_store.put(self._put(self._results_store.results, cached))

    def keep(self, result: Result) -> None:
        """Keep a result of the present request in place of the previous one."""
        if self._request is not None:
            others = [item for item in self._cache if item[0] != self._request]
            self._cache = deque([*others, (self._request, result)], self._cache.maxlen)

    def _take(self, result: Result) -> None:
        self.keep(result)
        self.ended.emit()
        self._results_store.put(self._put(self._results_store.results, result))

    def _fail(self, sentence: str) -> None:
        self.ended.emit()
        self.failed.emit(sentence)
