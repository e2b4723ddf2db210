"""Optics: where and how bright the lens images the panel. Effects change it one by one."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Self

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.row_memory import MEMORY


@dataclass(frozen=True, eq=False, slots=True)
class Gain:
    stage: str
    # Returns the factors at some rows, which may be between pixels, and in some columns
    at: Callable[[FloatArray, slice], Pixels]

    @classmethod
    def with_cache(
        cls, stage: str, depends_on: tuple[Hashable, ...], at: Callable[[FloatArray, slice], Pixels]
    ) -> Self:
        def recall_factors(rows: FloatArray, columns: slice) -> Pixels:
            place = (rows[0], rows[-1], len(rows), columns.start, columns.stop)
            return MEMORY.recall(
                (stage, *depends_on, *place), lambda: at(rows, columns), lambda factors: (factors,)
            )

        return cls(stage, recall_factors)


STAGE = "optics"  # the stage for computing time that belongs to no effect


@dataclass(frozen=True, eq=False, slots=True)
class Optics:
    # Shape (corners, 2): (column, row) of each corner of the panel's outline in the picture
    outline: FloatArray
    blur: float = 0.0  # Standard deviation of the lens's blur in pixels
    emission: tuple[Gain, ...] = field(default=())
    transmission: tuple[Gain, ...] = field(default=())
    cover_stage: str = STAGE  # The stage for the computing time of the panel's coverage

    @property
    def is_plain(self) -> bool:
        """Whether every pixel shows either the panel or the surroundings, without blur or gain."""
        return not (self.blur or self.emission or self.transmission)
