"""How a scene is simulated: what its picture may differ by, and where its noise comes from."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Literal, TypeAlias

from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.units import LEVEL

Observable: TypeAlias = Literal["profile", "image"]
"""What an error is counted in: the panel's bounding rectangle, or the means of its columns."""

OBSERVABLES: tuple[Observable, ...] = ("profile", "image")

NoiseSource: TypeAlias = Literal["exact", "reused"]
"""Whether noise is drawn for every pixel, or taken from a plane of noise again and again."""

NOISE_SOURCES: tuple[NoiseSource, ...] = ("exact", "reused")


TOLERANCE = Quantity(
    "tolerance",
    "Tolerance",
    "",
    "How much effects left out may change what is observed, in levels of the stretched profile.",
    unit=LEVEL, low=0.0, high=math.inf, slider=(0.01, 100.0), scale="log", default=0.5,
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class SimulationSettings:
    """All that :func:`occ_model.render` is told besides the scene.

    Parameters
    ----------
    tolerance
        How much effects left out may change, in levels of the stretched profile.
    observable
        What the tolerance is of.
    force
        Effects switched on (True) or off (False) by hand.
    noise
        Where noise comes from.
    seed
        Of all that is random.
    """

    tolerance: float = TOLERANCE.default
    observable: Observable = "image"
    force: Mapping[str, bool] = field(default_factory=dict)
    noise: NoiseSource = "exact"
    seed: int = 1

    def arguments(self) -> dict[str, Any]:
        """Give them as the keyword arguments of :func:`occ_model.render`."""
        return {each.name: getattr(self, each.name) for each in fields(self)}
