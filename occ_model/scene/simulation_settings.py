"""Settings of a simulation: its tolerance, its source of noise, its seed."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, Self, TypeAlias

from occ_model.scene.argument_checks import check_choice, check_seed, check_switches
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.units import LEVEL

Observable: TypeAlias = Literal["signal", "profile", "image", "decision"]
"""The quantity observed: the camera's pixels of the panel's bounding rectangle, the means of its
columns, what a decoder reads, the means of its columns after the receiver's enhancement, or the
code that is read, by how far the signal's chips keep from the threshold."""

OBSERVABLES: tuple[Observable, ...] = ("signal", "profile", "image", "decision")


def unit_of(observable: Observable) -> str:
    """Return the unit of tolerance and errors, as it stands behind a number."""
    return "margins" if observable == "decision" else LEVEL.symbol


NoiseSource: TypeAlias = Literal["exact", "reused"]
"""Source of noise: drawn for every pixel, or taken repeatedly from one plane of noise."""

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
    """The settings of :func:`occ_model.render`, which takes them one by one.

    Parameters
    ----------
    tolerance
        How much the effects left out may change the observable, root mean square in levels of the
        stretched profile.
    observable
        The quantity that the tolerance refers to.
    force
        Effects switched on (True) or off (False) by hand.
    noise
        The source of noise.
    seed
        Seed of all random numbers.
    """

    tolerance: float = TOLERANCE.default
    observable: Observable = "image"
    force: Mapping[str, bool] = field(default_factory=dict)
    noise: NoiseSource = "exact"
    seed: int = 1

    def checked(self, effects: Sequence[str]) -> Self:
        """Return the settings, the tolerance as a float, or raise a ParameterError.

        ``effects``: the names that ``force`` may have.
        """
        check_seed(self.seed)
        check_choice("noise", self.noise, NOISE_SOURCES)
        tolerance = TOLERANCE.check(self.tolerance)
        check_choice("observable", self.observable, OBSERVABLES)
        force = check_switches(self.force, effects)
        if tolerance is self.tolerance and force == self.force:
            return self
        return replace(self, tolerance=tolerance, force=force)
