"""Two states that the user has pinned, and how they differ."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class Pin:
    """A state that is kept to be compared.

    Parameters
    ----------
    scene
        The scene.
    tolerance
        With which it was simulated.
    profile : ndarray of float64, shape (columns,)
        Its profile in grey levels.
    first_column, packet_columns
        Where the panel begins in it, and how many columns one period of what is sent spans.
    outputs
        What came out, each as its name, its text and what it means.
    """

    scene: Scene
    tolerance: float
    profile: FloatArray
    first_column: float
    packet_columns: float
    outputs: tuple[tuple[str, str, str], ...]


@dataclass(frozen=True, slots=True)
class ComparedRow:
    """Something that differs between the two states.

    Parameters
    ----------
    what
        Its name.
    a, b
        What it is in each.
    meaning
        What it means.
    """

    what: str
    a: str
    b: str
    meaning: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class Pinned:
    """The two states, and what differs between them once there are both.

    Parameters
    ----------
    a, b
        The states, None where none has been pinned.
    inputs, outputs
        Only what differs.
    """

    a: Pin | None = None
    b: Pin | None = None
    inputs: tuple[ComparedRow, ...] = ()
    outputs: tuple[ComparedRow, ...] = ()
