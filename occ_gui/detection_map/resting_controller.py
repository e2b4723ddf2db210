"""Base of the controllers that measure once the scene rests."""

from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QObject, QTimer

from occ_gui.background.result_age import PAUSE
from occ_gui.background.signals import JobChannel
from occ_gui.detection_map.worker import UNSEEN
from occ_gui.scene.scene_store import SceneStore
from occ_model.receiver.decoders import PAPER_DECODER
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@dataclass(frozen=True, slots=True)
class RateRequest:
    scene: Scene
    settings: SimulationSettings
    decoder: str

    def along(self, name: str) -> "RateRequest":
        """Return the request of one slider's strip, which does not depend on the slider itself."""
        given = {**UNSEEN, name: quantity(name).default}
        return replace(self, scene=self.scene.replace(**given))


class RestingController(QObject):
    """Measures, while it is seen, what the present scene, settings and decoder ask for.

    A subclass says in :meth:`_move_on` what the present request changes, in :meth:`_measure` what
    to put into the channel, and in :meth:`_take` what to do with results.
    """

    def __init__(self, scenes: SceneStore, channel: JobChannel) -> None:
        super().__init__()
        self._scenes, self._channel = scenes, channel
        self._decoder = PAPER_DECODER
        self._seen = False
        self._asked: RateRequest | None = None
        self._resting = QTimer(self, singleShot=True)
        self._resting.setInterval(round(1e3 * PAUSE))
        self._resting.timeout.connect(self._measure)
        channel.results_ready.connect(self._take)
        for store in (scenes, scenes.settings):
            store.changed.connect(self._move_on)
        decoder = scenes.store.select(lambda workspace: workspace.decoder)
        decoder.changed.connect(self._move_on)

    @property
    def is_idle(self) -> bool:
        return self._channel.is_idle and not self._resting.isActive()

    def set_seen(self, seen: bool) -> None:
        self._seen = seen
        if seen:
            self._move_on()
        else:
            self._resting.stop()
            self._channel.cancel()
            self._forget()

    def _forget(self) -> None:
        self._asked = None

    def _present(self) -> RateRequest:
        decoder = self._scenes.store.workspace.decoder
        return RateRequest(self._scenes.scene, self._scenes.settings.settings, decoder)

    def _move_on(self) -> None:
        raise NotImplementedError

    def _measure(self) -> None:
        raise NotImplementedError

    def _take(self, request: RateRequest, results: list[Any]) -> None:
        raise NotImplementedError
