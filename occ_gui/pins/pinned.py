"""Two states that the user has pinned, and their differences."""

from collections.abc import Mapping
from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class Pin:
    """A state kept for comparison: its scene, profile and outputs.

    Parameters
    ----------
    scene
        The scene.
    tolerance
        The tolerance of its simulation.
    force
        The effects forced on (True) or off (False) by hand.
    profile : ndarray of float64, shape (columns,)
        Its profile in grey levels.
    first_column, packet_columns
        The first column of the panel, and the columns of one period of the signal sent.
    outputs
        The outputs, each as its name, its text and its meaning.
    """

    scene: Scene
    tolerance: float
    force: Mapping[str, bool]
    profile: FloatArray
    first_column: float
    packet_columns: float
    outputs: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True, slots=True)
class ComparedRow:
    """One quantity that differs between the two states.

    Parameters
    ----------
    what
        The name of the quantity.
    a, b
        Its value in each state.
    meaning
        Its meaning.
    """

    what: str
    a: str
    b: str
    meaning: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class Pinned:
    """The two states, and their differences if both are pinned.

    Parameters
    ----------
    a, b
        The states, None if not pinned.
    inputs, outputs
        The inputs and outputs that differ.
    """

    a: Pin | None = None
    b: Pin | None = None
    inputs: tuple[ComparedRow, ...] = ()
    outputs: tuple[ComparedRow, ...] = ()
