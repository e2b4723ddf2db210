"""Settings of a simulation: its tolerance, its source of noise, its seed."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, Self, TypeAlias

from occ_model.scene.argument_checks import check_choice, check_seed, check_switches
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
    """The settings of :func:`occ_model.render`, which takes them one by one.

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

    def checked(self, effects: Sequence[str]) -> Self:
        """Return the settings, the tolerance as a float, or refuse them.

        Parameters
        ----------
        effects
            The names that ``force`` may have.

        Raises
        ------
        ParameterError
            Naming the setting, its value and what is allowed.
        """
        check_seed(self.seed)
        check_choice("noise", self.noise, NOISE_SOURCES)
        tolerance = TOLERANCE.check(self.tolerance)
        check_choice("observable", self.observable, OBSERVABLES)
        return replace(self, tolerance=tolerance, force=check_switches(self.force, effects))
