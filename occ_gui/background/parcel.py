"""Pieces of work that processes take over from the window; nothing here needs Qt."""

from collections.abc import Callable, Iterable, MutableSequence
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

Pulse: TypeAlias = Callable[[], object]
"""Is called again and again by whatever takes long; it ends the work by raising."""


class Abandoned(Exception):  # noqa: N818 - no error: nobody waits for the work any more
    """Ends work whose result is no longer wanted."""


@dataclass(frozen=True, slots=True)
class Parcel:
    """A call that another process makes.

    Parameters
    ----------
    function
        A function of some module; it is handed a :data:`Pulse` after the arguments, and must not
        need Qt.
    arguments
        Values that can be sent to a process.
    slot
        Where the pulses are counted.
    """

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    slot: int = 0


@dataclass(frozen=True, slots=True)
class Stage:
    """Parcels that belong together.

    Parameters
    ----------
    rank
        Of all parcels that wait, those of the lowest rank go first.
    parcels
        The parcels, in the order in which they are done.
    stays
        Whether the stage is ended, once begun, also when something newer is asked for.
    """

    rank: int
    parcels: tuple[Parcel, ...]
    stays: bool = False


SLOTS = 8
"""Lanes that there can be, and places to count pulses in."""

Stages: TypeAlias = Callable[[], Iterable[Stage]]
"""Gives the stages of some work, one after the other; it is called off the window's thread."""


@dataclass(frozen=True, slots=True)
class Task:
    """A parcel on its way.

    Parameters
    ----------
    lane, run
        Whose it is: when a later run of the lane is wanted, this one is abandoned.
    parcel
        What is to be done.
    """

    lane: int
    run: int
    parcel: Parcel


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a task; the result counts only where it was not abandoned."""

    result: Any
    abandoned: bool = False


def do_task(task: Task, floors: MutableSequence[int], counts: MutableSequence[int]) -> Outcome:
    """Do a task.

    Parameters
    ----------
    task
        What is to be done.
    floors
        The earliest run of each lane that is not abandoned; looked at with every pulse.
    counts
        The pulses of each slot, which those of the task are added to.
    """
    parcel = task.parcel

    def pulse() -> None:
        if floors[task.lane] > task.run:
            raise Abandoned
        counts[parcel.slot] += 1

    try:
        pulse()
        return Outcome(parcel.function(*parcel.arguments, pulse))
    except Abandoned:
        return Outcome(None, abandoned=True)


class Workers(Protocol):
    """Whoever does the work."""

    count: int

    def submit(self, task: Task) -> "Future[Outcome]":
        """Hand over a task."""

    def abandon(self, lane: int, run: int) -> None:
        """Let go of all runs of a lane that are earlier than ``run``."""

    def counted(self, slot: int) -> int:
        """Say how many pulses there were in a slot."""

    def renew(self) -> None:
        """Replace workers that died."""

    def close(self) -> None:
        """Let them go, whatever they are at."""
