"""What the status line tells the user."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, eq=False, slots=True)
class Remark:
    sentence: str
    select_state: Callable[..., object]
    """Takes workspace and results; returns the value whose change ends the remark."""
    state: object  # that value at the time of the remark


@dataclass(frozen=True, eq=False, slots=True)
class Failure:
    """Why a scene has no picture."""

    sentence: str
    parameters: tuple[str, ...]  # names of the parameters that the sentence is about
