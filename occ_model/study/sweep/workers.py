"""Handing a sweep's points to workers, and carrying on when workers die."""

import warnings
from collections.abc import Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from itertools import chain, islice
from typing import Protocol

from occ_model.results import SweepPoint, SweepRequest
from occ_model.study.sweep.points import Delivery, Parcel, Pulse, measure_here, measure_parcel

_PARCEL_SECONDS = 0.1
"""Work in a parcel: so much that handing it over costs little, so little that none waits long."""

_BEAT = 0.2
"""Seconds after which whoever waits for workers shows a sign of life."""

_UNKNOWN_WORKERS = 32
"""Workers that an executor is taken to have that does not say."""

_TRIES = 3
"""How often workers may die one after the other with nothing delivered in between."""


class Workers(Protocol):
    """Whoever does the work."""

    count: int

    def submit(self, parcel: Parcel) -> "Future[Delivery]":
        """Hand over a parcel."""

    def renew(self) -> bool:
        """Replace workers that died; say whether that can be done."""

    def close(self) -> None:
        """Let them go, whatever they are at."""


class GivenWorkers:
    """An executor that belongs to the caller: it is neither renewed nor closed."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor
        self.count: int = getattr(executor, "_max_workers", _UNKNOWN_WORKERS)

    def submit(self, parcel: Parcel) -> "Future[Delivery]":
        """Hand over a parcel."""
        return self._executor.submit(measure_parcel, parcel)

    def renew(self) -> bool:
        """Say that it cannot be renewed."""
        return False

    def close(self) -> None:
        """Leave it to its owner."""


class WorkersLostError(Exception):
    """All workers are gone; the points that were in flight are the argument."""


def measure_by(
    workers: Workers, request: SweepRequest, indices: Iterator[int], pulse: Pulse
) -> Generator[SweepPoint, None, None]:
    """Measure points by workers, in the order in which they are ready.

    A bounded number of parcels is in flight at a time. When workers die the points that they had
    are measured again, by new ones, or here where there are none: a point depends on nothing but
    itself.
    """
    in_flight = _InFlight(workers, request, indices)
    failures = 0
    try:
        while in_flight.fill():
            pulse()
            try:
                for point in in_flight.delivered():
                    failures = 0
                    yield point
            except WorkersLostError as loss:
                failures += 1
                if failures >= _TRIES or not workers.renew():
                    warnings.warn(
                        f"The sweep's workers are gone ({loss}); this process finishes it alone.",
                        RuntimeWarning,
                        stacklevel=2,
                    )
                    break
        yield from measure_here(request, in_flight.left(), pulse)
    finally:
        in_flight.cancel()
        workers.close()


class _InFlight:
    """The parcels in flight, and the points that are still to be sent."""

    def __init__(self, workers: Workers, request: SweepRequest, indices: Iterator[int]) -> None:
        self._workers = workers
        self._request = request
        self._indices = indices
        self._flying: dict[Future[Delivery], Parcel] = {}
        self._pace = 0.0
        self._lost_by = ""

    def fill(self) -> bool:
        """Send parcels until there are enough in flight; say whether any are, or are to be."""
        while not self._lost_by and len(self._flying) < 2 * self._workers.count:
            chosen = tuple(islice(self._indices, self._size()))
            if not chosen:
                break
            values = tuple((index, self._request.values(index)) for index in chosen)
            parcel = Parcel(self._request.scene, self._request.settings, values)
            try:
                self._flying[self._workers.submit(parcel)] = parcel
            except Exception as error:  # noqa: BLE001 - each executor has its own for being gone
                self._indices = chain(chosen, self._indices)
                self._lost_by = _cause(error)
        return bool(self._flying or self._lost_by)

    def _size(self) -> int:
        """Give the points to a parcel: one until their time is known."""
        return max(1, int(_PARCEL_SECONDS / self._pace)) if self._pace else 1

    def delivered(self) -> Iterator[SweepPoint]:
        """Wait a little for parcels to come back, and give the points in them.

        Raises
        ------
        WorkersLostError
            Workers died; their points are to be sent again.
        """
        ready, _ = wait(self._flying, timeout=_BEAT, return_when=FIRST_COMPLETED)
        again: list[int] = []
        for future in ready:
            parcel = self._flying[future]
            try:
                delivery = future.result()
            except Exception as error:  # noqa: BLE001 - each executor has its own for being gone
                self._lost_by = _cause(error)
                again += parcel.indices
                del self._flying[future]
                continue
            del self._flying[future]
            if delivery.error is not None:
                raise delivery.error
            self._pace = delivery.seconds / len(delivery.points)
            yield from delivery.points
        if self._lost_by:
            # What else is in flight is lost, too, or not: to measure it again harms nobody.
            again += chain.from_iterable(parcel.indices for parcel in self._flying.values())
            self.cancel()
            self._indices = chain(again, self._indices)
            cause, self._lost_by = self._lost_by, ""
            raise WorkersLostError(cause)

    def left(self) -> Iterator[int]:
        """Give the points that nobody has measured."""
        return self._indices

    def cancel(self) -> None:
        """Call back what is in flight."""
        for future in self._flying:
            future.cancel()
        self._flying.clear()


def _cause(error: BaseException) -> str:
    """Say in words what became of the workers."""
    text = " ".join(str(error).split()).rstrip(".")
    name = type(error).__name__
    return f"{name}: {text}" if text else name
