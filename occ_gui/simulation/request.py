"""What a thread in the background is asked to simulate."""

from dataclasses import dataclass

from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@dataclass(frozen=True, slots=True)
class SimulationRequest:
    """A scene, and how it is simulated.

    Parameters
    ----------
    scene
        The scene.
    settings
        All that is said besides it.
    """

    scene: Scene
    settings: SimulationSettings
