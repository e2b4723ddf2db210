"""How the window simulates its scene: one frozen value, changed in one place."""

from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from occ_model.errors import OccError
from occ_model.scene.simulation_settings import (
    TOLERANCE,
    NoiseSource,
    Observable,
    SimulationSettings,
)

FIRST_SETTINGS = SimulationSettings(noise="reused")
"""What the window begins with: noise that keeps up with a slider."""


class SettingsStore(QObject):
    """Holds the simulation's settings and tells when they change.

    Parameters
    ----------
    settings
        The settings to begin with.
    """

    changed = Signal(object)
    """The new settings."""

    refused = Signal(str)
    """Why a change was not made; the settings are as they were."""

    def __init__(self, settings: SimulationSettings = FIRST_SETTINGS) -> None:
        super().__init__()
        self._settings = settings

    @property
    def settings(self) -> SimulationSettings:
        """The settings as they are now."""
        return self._settings

    def set_tolerance(self, tolerance: float) -> None:
        """Change the tolerance; one that cannot be is refused with a sentence."""
        try:
            self._put(replace(self._settings, tolerance=TOLERANCE.check(tolerance)))
        except OccError as error:
            self.refused.emit(str(error))

    def set_observable(self, observable: Observable) -> None:
        """Say what the tolerance is of."""
        self._put(replace(self._settings, observable=observable))

    def set_noise(self, noise: NoiseSource) -> None:
        """Say where noise comes from."""
        self._put(replace(self._settings, noise=noise))

    def force(self, effect: str, included: bool | None) -> None:
        """Switch an effect on or off by hand, or leave it to the plan (None)."""
        others = {name: on for name, on in self._settings.force.items() if name != effect}
        by_hand = {} if included is None else {effect: included}
        self._put(replace(self._settings, force={**others, **by_hand}))

    def _put(self, settings: SimulationSettings) -> None:
        if settings != self._settings:
            self._settings = settings
            self.changed.emit(settings)
