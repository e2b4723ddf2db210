"""Age of results: the time since their request was replaced."""

import math
from collections import deque
from collections.abc import Callable
from time import monotonic
from typing import Generic, TypeVar

Request = TypeVar("Request")

PAUSE = 0.15  # seconds; changes that follow faster are one movement, such as a drag of a slider

_REMEMBERED_REQUESTS = 64  # number of former requests that are remembered


class ResultAges(Generic[Request]):
    """The present request, and when each former one was replaced."""

    def __init__(self, request: Request, clock: Callable[[], float] = monotonic) -> None:
        self.present = request
        self._clock = clock
        self._former_requests: deque[tuple[Request, float]] = deque(maxlen=_REMEMBERED_REQUESTS)
        self._changed_at = -math.inf
        self._is_moving = False

    def begin(self, request: Request) -> None:
        if request == self.present:
            return
        now = self._clock()
        self._is_moving = now - self._changed_at < PAUSE
        self._changed_at = now
        self._former_requests.append((self.present, now))
        self.present = request

    def age(self, request: Request | None) -> float:
        """Return the seconds since a request was replaced.

        Zero for the present request; infinite for None, and for a request that is not remembered.
        """
        if request == self.present:
            return 0.0
        times = (time for former, time in reversed(self._former_requests) if former == request)
        replaced_at = next(times, -math.inf)
        return self._clock() - replaced_at

    def rest(self, pause: float = PAUSE) -> float:
        """Return the seconds until the movement counts as ended; zero after a single change.

        ``pause``: seconds without a change after which a movement has ended.
        """
        if not self._is_moving:
            return 0.0
        return max(0.0, self._changed_at + pause - self._clock())
