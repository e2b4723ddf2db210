"""Settings store: edits of the settings of the simulation."""

from collections.abc import Mapping
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from occ_gui.core.store import Store
from occ_model.errors import OccError
from occ_model.scene.refusal import refusal_of
from occ_model.scene.simulation_settings import (
    TOLERANCE,
    NoiseSource,
    Observable,
    SimulationSettings,
)


class SettingsStore(QObject):
    """The settings of the simulation in a workspace, and the edits of them.

    ``effect_labels`` are the names on the screen of all effects, by their names in the program.
    """

    changed = Signal(object)

    refused = Signal(str)  # the reason why a change was not made; the settings are unchanged

    def __init__(self, store: Store, effect_labels: Mapping[str, str] | None = None) -> None:
        super().__init__()
        self.effect_labels = effect_labels or {}
        self._store = store
        store.select(lambda workspace: workspace.settings).changed.connect(self.changed)

    @property
    def settings(self) -> SimulationSettings:
        return self._store.workspace.settings

    def set_tolerance(self, tolerance: float) -> None:
        try:
            self._put(replace(self.settings, tolerance=TOLERANCE.check(tolerance)))
        except OccError as error:
            self.refused.emit(refusal_of(error))

    def set_observable(self, observable: Observable) -> None:
        self._put(replace(self.settings, observable=observable))

    def set_noise(self, noise: NoiseSource) -> None:
        self._put(replace(self.settings, noise=noise))

    def _put(self, settings: SimulationSettings) -> None:
        self._store.put(replace(self._store.workspace, settings=settings))
