"""What a sweep measures: the scene, the axes, and how each rate is found."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Literal, TypeAlias

from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import TOLERANCE

SignalPath: TypeAlias = Literal["auto", "profile", "image"]
"""How a decoder gets to see a scene: by the column means alone, by the whole image, or whichever
of them the plan allows for."""

SIGNAL_PATHS: tuple[SignalPath, ...] = ("auto", "profile", "image")

MOST_POINTS = 1_000_000
"""Points of a sweep: what is counted at each is kept in memory, and written as a table at once."""

MOST_AXES = 31
"""Parameters that a sweep varies: numpy's arrays have 32 axes, and one is that of the decoders."""

MOST_IMAGES = 1_000_000
"""Images at a point."""

MOST_JOBS = 1024
"""Processes that may be asked for."""

JOBS_A_CORE = 4
"""Processes that are started at most for each core: more take memory, and no less time."""

_SLOWEST = ("bits", "exposure_time", "switching_frequency")
"""Parameters that change last on the way from point to point: with each of them the matched decoder
needs the forward model of all codes anew."""


@dataclass(frozen=True, slots=True)
class RateSettings:
    """How a success rate is measured.

    Parameters
    ----------
    images
        How many images are read.
    decoders
        By which decoders; all read the same images.
    seed
        Of the images' start times and noise.
    tolerance, force
        As for :func:`occ_model.plan`.
    path
        As for :func:`occ_model.success_rate`.
    """

    images: int
    decoders: tuple[str, ...]
    seed: int = 1
    tolerance: float = TOLERANCE.default
    force: Mapping[str, bool] = field(default_factory=dict)
    path: SignalPath = "auto"


@dataclass(frozen=True, slots=True)
class SweepRequest:
    """What a sweep measures.

    Parameters
    ----------
    scene
        Where the axes start from.
    axes
        The values of each parameter that is varied, in SI units.
    settings
        How each rate is measured.
    """

    scene: Scene
    axes: Mapping[str, tuple[ParameterValue, ...]]
    settings: RateSettings

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each axis has."""
        return tuple(len(values) for values in self.axes.values())

    @property
    def points(self) -> int:
        """How many points the axes span."""
        return math.prod(self.shape)

    def values(self, index: int) -> dict[str, ParameterValue]:
        """Give the parameters of a point; points are counted with the last axis first."""
        found: list[ParameterValue] = []
        for values in reversed(list(self.axes.values())):
            index, place = divmod(index, len(values))
            found.append(values[place])
        return dict(zip(self.axes, reversed(found), strict=True))

    def in_order_of_work(self) -> Iterator[int]:
        """Count the points in the order in which they take the least time."""
        names = list(self.axes)
        slow = sorted((name for name in names if name in _SLOWEST), key=_SLOWEST.index)
        order = [*slow, *(name for name in names if name not in _SLOWEST)]
        sizes = [math.prod(self.shape[names.index(name) + 1 :]) for name in order]
        for place in product(*(range(len(self.axes[name])) for name in order)):
            yield sum(size * step for size, step in zip(sizes, place, strict=True))


@dataclass(frozen=True, slots=True)
class SweepPoint:
    """What was measured at one point.

    Parameters
    ----------
    index
        Which point, counted with the last axis first.
    sent
        Bits sent in all images, 0 where the model refuses the scene.
    right
        Bits of them that each decoder read rightly.
    note
        Why the model refuses the scene, empty where it does not.
    """

    index: int
    sent: int
    right: tuple[int, ...]
    note: str = ""
