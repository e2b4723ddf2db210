"""Requests for a simulation, which identify simulated pictures and pins."""

from dataclasses import dataclass, field
from typing import TypeAlias

from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene, SimulationSettings

LEAST_DRAFT_STEP = 4
"""Least number of picture rows per row of a draft: with fewer, a draft is no faster."""


@dataclass(frozen=True, slots=True)
class SimulationRequest:
    scene: Scene
    settings: SimulationSettings
    # Not compared: neither the kind of picture nor the step of a draft changes the results
    picture_kind: str = field(default=PICTURES[0], compare=False)
    # A draft simulates one of this many rows of the picture
    draft_step: int = field(default=LEAST_DRAFT_STEP, compare=False)
    more_decoders: tuple[str, ...] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class PinnedScene:
    """A pinned request, and the preset of its scene; empty for none."""

    request: SimulationRequest
    preset: str = ""


Pins: TypeAlias = tuple[PinnedScene | None, PinnedScene | None]
