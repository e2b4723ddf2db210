"""Times of a slider's moves: of the draft and of the picture, by the effects simulated."""

from collections import deque
from dataclasses import dataclass
from typing import TypeAlias

from occ_model.results.accuracy import MeasuredCosts, TimeFractions, Times
from occ_model.results.frame import Frame

_KEPT = 9  # last moves that count


@dataclass(frozen=True, slots=True)
class MoveTime:
    """The time that one move took for its picture, for the draft before it, or for both."""

    size: tuple[int, int]  # rows and columns of the picture
    effects: frozenset[str]
    picture: TimeFractions | None = None
    draft_seconds: float | None = None

    @classmethod
    def of(cls, frame: Frame, draft_seconds: float | None = None) -> "MoveTime":
        """Return the time of a whole picture, or of a draft, which took ``draft_seconds``."""
        camera, times = frame.scene.camera, TimeFractions.of(frame)
        size = camera.rows, camera.columns
        picture = times if draft_seconds is None else None
        return cls(size, times.included, picture, draft_seconds)


_Key: TypeAlias = tuple[tuple[int, int], frozenset[str]]


class MoveLog:
    """The last moves of this session, by the picture's size and its effects."""

    def __init__(self) -> None:
        self._pictures: dict[_Key, deque[TimeFractions]] = {}
        self._drafts: dict[_Key, deque[float]] = {}

    def add(self, time: MoveTime) -> None:
        key = time.size, time.effects
        if time.picture is not None:
            runs = self._pictures.pop(key, deque(maxlen=_KEPT))
            runs.append(time.picture)
            self._pictures[key] = runs  # the latest come last
        if time.draft_seconds is not None:
            self._drafts.setdefault(key, deque(maxlen=_KEPT)).append(time.draft_seconds)

    def costs_of(self, frame: Frame) -> MeasuredCosts:
        """Return the times of moves like that of a picture, and of others, the latest first."""
        last = MoveTime.of(frame)
        pictures = {
            effects: TimeFractions.of_runs(runs)
            for (size, effects), runs in reversed(self._pictures.items())
            if size == last.size
        }
        own = pictures.pop(last.effects, TimeFractions.of(frame))
        drafts = self._drafts.get((last.size, last.effects))
        draft = Times.of(drafts) if drafts else None
        return MeasuredCosts(own, tuple(pictures.values()), draft=draft)
