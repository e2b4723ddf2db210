"""What is simulated: a scene with settings, by which pictures and pins are known."""

from dataclasses import dataclass, field
from typing import TypeAlias

from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

LEAST_DRAFT_STEP = 4
"""Rows of the picture that a row of a draft stands for at least: fewer are no sooner there."""


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
    """What was pinned, and the preset that its scene was changed from; empty for none."""

    request: SimulationRequest
    preset: str = ""


Pins: TypeAlias = tuple[PinnedScene | None, PinnedScene | None]
