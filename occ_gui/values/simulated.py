"""A scene with settings, by which simulated pictures and pins are identified."""

from dataclasses import dataclass, field
from typing import TypeAlias

from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

LEAST_DRAFT_STEP = 4
"""Fewest rows of the picture for each row of a draft: with fewer it is no faster."""


@dataclass(frozen=True, slots=True)
class SimulationRequest:
    scene: Scene
    settings: SimulationSettings
    # Neither changes the results.
    whose: str = field(default=PICTURES[0], compare=False)
    # A draft shows one of so many rows of the picture
    draft_step: int = field(default=LEAST_DRAFT_STEP, compare=False)
    more: tuple[str, ...] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class PinnedScene:
    """A pinned request, and the preset of its scene; empty for none."""

    request: SimulationRequest
    preset: str = ""


Pins: TypeAlias = tuple[PinnedScene | None, PinnedScene | None]
