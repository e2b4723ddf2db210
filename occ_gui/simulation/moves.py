"""Times of a slider's moves: of the draft and of the picture, by the effects simulated."""

from collections import deque
from dataclasses import dataclass
from time import perf_counter
from typing import TypeAlias

from occ_gui.simulation.jobs import (
    draft_of,
    reading_by_profile,
    reading_of_draft,
    snapshot_of,
)
from occ_gui.simulation.snapshot import Reading
from occ_gui.values.simulated import SimulationRequest
from occ_model.results.accuracy import MeasuredCosts, TimeFractions, Times
from occ_model.results.frame import Frame
from occ_model.simulation.render import PlannedScene, plan_scene, render_with

_KEPT = 9  # last moves that count


@dataclass(frozen=True, eq=False, slots=True)
class BegunMove:
    """A move until its draft: the plan, and what can be shown of it so far."""

    planned: PlannedScene
    reading: Reading | None
    draft: Frame | None
    draft_seconds: float


def begin_move(request: SimulationRequest) -> BegunMove:
    """Plan a scene, read it by its profile, and simulate and read a draft if that is needed."""
    start = perf_counter()
    planned = plan_scene(request.scene, request.settings)  # once for all that follows
    reading = reading_by_profile(request, planned)
    draft = draft_of(request, planned)
    if draft is not None:
        reading = reading or reading_of_draft(request, draft)
    return BegunMove(planned, reading, draft, perf_counter() - start)


@dataclass(frozen=True, slots=True)
class MoveTime:
    """What one move took: the picture, the draft before it, or both."""

    size: tuple[int, int]  # rows and columns of the picture
    effects: frozenset[str]
    picture: TimeFractions | None = None
    draft_seconds: float | None = None

    @classmethod
    def of(cls, frame: Frame, draft_seconds: float | None = None) -> "MoveTime":
        """Return the time of a picture; with ``draft_seconds``, of the draft that it is."""
        camera, times = frame.scene.camera, TimeFractions.of(frame)
        size = camera.rows, camera.columns
        picture = times if draft_seconds is None else None
        return cls(size, times.included, picture, draft_seconds)


def time_move(request: SimulationRequest, *, with_draft: bool) -> list[MoveTime]:
    """Simulate a scene as after a slider's move, and time it."""
    times = []
    planned = None
    if with_draft:
        move = begin_move(request)
        planned = move.planned
        if move.draft is not None:
            times.append(MoveTime.of(move.draft, move.draft_seconds))
    frame = render_with(request.scene, request.settings, planned=planned)
    snapshot_of(request, frame)  # which may need the receiver's picture, too
    return [*times, MoveTime.of(frame)]


_Key: TypeAlias = tuple[tuple[int, int], frozenset[str]]


class MoveLog:
    """The last moves of this session, by the picture's size and its effects."""

    def __init__(self) -> None:
        self._pictures: dict[_Key, deque[TimeFractions]] = {}
        self._drafts: dict[_Key, deque[float]] = {}

    def add(self, time: MoveTime) -> None:
        key = time.size, time.effects
        if time.picture is not None:
            self._pictures.setdefault(key, deque(maxlen=_KEPT)).append(time.picture)
        if time.draft_seconds is not None:
            self._drafts.setdefault(key, deque(maxlen=_KEPT)).append(time.draft_seconds)

    def costs_of(self, frame: Frame) -> MeasuredCosts:
        """Return the times of moves like that of a picture, and of others of its size."""
        last = MoveTime.of(frame)
        pictures = {
            effects: TimeFractions.of_runs(runs)
            for (size, effects), runs in self._pictures.items()
            if size == last.size
        }
        own = pictures.pop(last.effects, TimeFractions.of(frame))
        drafts = self._drafts.get((last.size, last.effects))
        draft = Times.of(drafts) if drafts else None
        return MeasuredCosts(own, tuple(pictures.values()), draft=draft)
