"""What is said to the user in the status line."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, eq=False, slots=True)
class Remark:
    sentence: str
    until: Callable[..., object]
    """Takes workspace and results; returns that part with whose change it no longer holds."""
    state: object  # that part, as it was when it was said


@dataclass(frozen=True, eq=False, slots=True)
class Failure:
    """Why a scene has no picture."""

    sentence: str
    parameters: tuple[str, ...]  # those that it is about
