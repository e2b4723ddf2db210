"""Optics: how the lens pictures the panel, changed by one effect after the other."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Self

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.row_memory import MEMORY


@dataclass(frozen=True, eq=False, slots=True)
class Gain:
    stage: str
    # Gives the factors at some rows, which may lie between pixels, and in some columns
    at: Callable[[FloatArray, slice], Pixels]

    @classmethod
    def remembered(
        cls, stage: str, depends_on: tuple[Hashable, ...], at: Callable[[FloatArray, slice], Pixels]
    ) -> Self:
        def recalled(rows: FloatArray, columns: slice) -> Pixels:
            place = (rows[0], rows[-1], len(rows), columns.start, columns.stop)
            return MEMORY.recall((stage, *depends_on, *place), lambda: at(rows, columns), _itself)

        return cls(stage, recalled)


def _itself(factors: Pixels) -> tuple[Pixels]:
    return (factors,)


STAGE = "optics"  # the stage that the time of no effect in particular is counted under


@dataclass(frozen=True, eq=False, slots=True)
class Optics:
    # Shape (corners, 2): the panel's outline in the picture, (column, row) of each corner
    outline: FloatArray
    blur: float = 0.0  # Standard deviation of the lens's blur in pixels
    emission: tuple[Gain, ...] = field(default=())
    transmission: tuple[Gain, ...] = field(default=())
    # The stage that the time to compute the panel's coverage is counted under
    cover_stage: str = STAGE

    @property
    def is_plain(self) -> bool:
        """Whether every pixel shows either the panel or its surroundings, without blur or gain."""
        return not (self.blur or self.emission or self.transmission)
