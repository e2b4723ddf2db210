"""Settings store: the current settings of the simulation, an immutable value."""

from collections.abc import Mapping
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
"""The first settings of the window, with noise that is fast enough for sliders."""


class SettingsStore(QObject):
    """Stores the settings of the simulation and emits a signal when they change.

    Parameters
    ----------
    settings
        The first settings.
    effect_labels
        The names on the screen of all effects, by their names in the program.
    """

    changed = Signal(object)
    """The new settings."""

    refused = Signal(str)
    """The reason why a change was not made; the settings are unchanged."""

    def __init__(
        self,
        settings: SimulationSettings = FIRST_SETTINGS,
        effect_labels: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__()
        self.effect_labels = effect_labels or {}
        self._settings = settings

    @property
    def settings(self) -> SimulationSettings:
        """The current settings."""
        return self._settings

    def set_tolerance(self, tolerance: float) -> None:
        """Change the tolerance; an invalid one is refused with a sentence."""
        try:
            self._put(replace(self._settings, tolerance=TOLERANCE.check(tolerance)))
        except OccError as error:
            self.refused.emit(str(error))

    def set_observable(self, observable: Observable) -> None:
        """Change the observable whose error the tolerance limits."""
        self._put(replace(self._settings, observable=observable))

    def set_noise(self, noise: NoiseSource) -> None:
        """Change the source of the noise."""
        self._put(replace(self._settings, noise=noise))

    def set_force(self, force: Mapping[str, bool]) -> None:
        """Change which effects are forced; the scene store does it, as steps to undo."""
        self._put(replace(self._settings, force=dict(force)))

    def restore(self, settings: SimulationSettings) -> None:
        """Change all settings but the forced effects to these."""
        self._put(replace(settings, force=self._settings.force))

    def _put(self, settings: SimulationSettings) -> None:
        if settings != self._settings:
            self._settings = settings
            self.changed.emit(settings)
