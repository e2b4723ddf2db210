"""Settings of a simulation: tolerance, observable, switched effects, source of noise, seed."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, Self, TypeAlias

from occ_model.scene.argument_checks import check_choice, check_seed, check_switches
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.units import LEVEL

Observable: TypeAlias = Literal["signal", "profile", "image", "decision"]
"""The quantity to which a tolerance refers. "image": the camera's pixels in the panel's bounding
rectangle; "profile": the means of its columns; "signal": these means after the receiver's
enhancement, which a decoder reads; "decision": the code that is read, by the signal's distance from
the threshold."""

OBSERVABLES: tuple[Observable, ...] = ("signal", "profile", "image", "decision")


def unit_of(observable: Observable) -> str:
    """Return the unit of tolerances and errors, as written after a number."""
    return "margins" if observable == "decision" else LEVEL.symbol


NoiseSource: TypeAlias = Literal["exact", "reused"]
"""Source of noise: random numbers for every pixel, or one stored plane of noise used repeatedly."""

NOISE_SOURCES: tuple[NoiseSource, ...] = ("exact", "reused")


TOLERANCE = Quantity(
    "tolerance",
    "Tolerance",
    "",
    "How much the omitted effects may change the observable, in levels of the stretched profile.",
    unit=LEVEL, low=0.0, high=math.inf, slider=(0.01, 100.0), scale="log", default=0.5,
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class SimulationSettings:
    """The settings of :func:`occ_model.render`, which takes them one by one.

    Parameters
    ----------
    tolerance
        How much the omitted effects may change the observable, root mean square in levels of the
        stretched profile.
    observable
        The quantity to which the tolerance refers.
    force
        Effects that the user has switched on (True) or off (False).
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

    def check(self, effects: Sequence[str]) -> Self:
        """Return the settings with the tolerance as a float; ParameterError if any is wrong.

        ``effects`` are the names that ``force`` may have.
        """
        check_seed(self.seed)
        check_choice("noise", self.noise, NOISE_SOURCES)
        tolerance = TOLERANCE.check(self.tolerance)
        check_choice("observable", self.observable, OBSERVABLES)
        force = check_switches(self.force, effects)
        if tolerance is self.tolerance and force == self.force:
            return self
        return replace(self, tolerance=tolerance, force=force)
