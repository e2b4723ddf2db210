"""Two states that the user has pinned, and their differences."""

from dataclasses import dataclass

from occ_gui.values.simulated import SimulationRequest
from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@dataclass(frozen=True, eq=False, slots=True)
class Pin:
    request: SimulationRequest
    profile: FloatArray  # shape (columns,): its profile in grey levels
    # The first column of the panel, and the columns of one period of the signal sent
    first_column: float
    packet_columns: float
    outputs: tuple[tuple[str, str, str], ...]

    @property
    def scene(self) -> Scene:
        return self.request.scene

    @property
    def settings(self) -> SimulationSettings:
        return self.request.settings


@dataclass(frozen=True, slots=True)
class ComparedRow:
    what: str
    a: str
    b: str
    meaning: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class Pinned:
    a: Pin | None = None
    b: Pin | None = None
    inputs: tuple[ComparedRow, ...] = ()
    outputs: tuple[ComparedRow, ...] = ()
