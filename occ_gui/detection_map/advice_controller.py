"""Controller of the advisor: it searches for the limits of a scene when the user asks."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.background.signals import JobChannel, WorkQueue
from occ_gui.core.store import NO_GESTURE
from occ_gui.detection_map.advice_view import AdviceView
from occ_gui.detection_map.advice_worker import advise
from occ_gui.detection_map.worker import left_out, rate_settings
from occ_gui.scene.scene_store import SceneStore
from occ_model.parallel.job import Job, Stage
from occ_model.receiver.decoders import DECODERS
from occ_model.results.advice import Advice
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.study.limits import SEARCHED, usual_images

RATE = 99.0  # success rate, in percent, from which a decoder counts as reading

IMAGES = 20

_USUAL = len(SEARCHED) * usual_images(IMAGES, RATE)
"""Images that a decoder's search usually reads, from which its progress is estimated."""

_LOOK_MS = 100

ASKED, IN_TURN = -1, 3
"""Ranks: before all else where the user asks; otherwise after all points of a map that is seen,
before further images of them."""


@dataclass(frozen=True, slots=True)
class AdviceRequest:
    scene: Scene
    settings: SimulationSettings
    with_image_effects: bool

    def along(self, name: str) -> "AdviceRequest":
        """Return the request without a parameter's value, which its limits do not depend on."""
        scene = self.scene.replace(**{name: quantity(name).default})
        return replace(self, scene=scene)

    def stages(self, rank: int) -> Iterator[Stage]:
        jobs = []
        for counter, decoder in enumerate(DECODERS, 1):
            settings = rate_settings(self.settings, IMAGES, (decoder,), self.with_image_effects)
            jobs.append(Job(advise, (self.scene, settings, decoder, RATE), counter))
        yield Stage(rank, tuple(jobs))


class AdvisorController(QObject):
    went = Signal(str)  # the scene was set to a limit; the decoder that reads there

    def __init__(
        self,
        scenes: SceneStore,
        queue: WorkQueue,
        channel: JobChannel,
        pane: AdviceView,
    ) -> None:
        super().__init__()
        self._scenes = scenes
        self._queue, self.channel, self._pane = queue, channel, pane
        self._with_image_effects = True
        self._advised: AdviceRequest | None = None
        self._counted = 0
        self._look = QTimer(self)
        self._look.setInterval(_LOOK_MS)
        self._look.timeout.connect(self._show_progress)
        channel.results_ready.connect(self._take)
        channel.finished.connect(self._finish)
        channel.failed.connect(self._end)
        for store in (scenes, scenes.settings):
            store.changed.connect(self._move_on)

    def use_image_effects(self, wanted: bool) -> None:
        """Simulate rows of the picture where the scene needs them, or leave such effects out."""
        self._with_image_effects = wanted
        self._move_on()

    def _request(self) -> AdviceRequest:
        return AdviceRequest(
            self._scenes.scene, self._scenes.settings.settings, self._with_image_effects
        )

    def start(self) -> None:
        """Search for the limits of the current scene, as the user asks for them."""
        self._start(ASKED)

    def search_in_turn(self) -> None:
        """Search for the limits of the current scene, which the map does not wait for."""
        self._start(IN_TURN)

    def _start(self, rank: int) -> None:
        request = self._advised = self._request()
        self._counted = self._count()
        without = () if self._with_image_effects else left_out(request.scene, request.settings)
        self._pane.show_advice_begun(without)
        self.channel.put(request, partial(request.stages, rank))
        self._look.start()

    def cancel(self) -> None:
        if not self.channel.is_idle:
            self.channel.cancel()
            self._end("Cancelled.")

    def take_there(self, name: str, value: float, decoder: str) -> None:
        """Set the scene to a limit, in one step, and show what the decoder of the limit reads."""
        self._scenes.change(NO_GESTURE, **{name: value})
        self.went.emit(decoder)

    def _count(self) -> int:
        return sum(self._queue.counted(counter) for counter, _ in enumerate(DECODERS, 1))

    def _show_progress(self) -> None:
        if self.channel.is_idle:
            self._look.stop()
            return
        share = (self._count() - self._counted) / (_USUAL * len(DECODERS))
        self._pane.show_advice_progress(min(share, 0.99))

    def _take(self, _request: AdviceRequest, results: list[Advice]) -> None:
        for advice in results:
            self._pane.show_advice(advice)

    def _move_on(self) -> None:
        request = self._request()
        if self._advised is None:
            return
        if not self.channel.is_idle and request != self._advised:
            self.channel.cancel()
            self._end("The scene has changed; ask again.")
        reachable = frozenset(
            name for name in SEARCHED if self._advised.along(name) == request.along(name)
        )
        self._pane.show_advice_outdated(request != self._advised, reachable)

    def _finish(self, _request: AdviceRequest) -> None:
        self._end("")

    def _end(self, sentence: str) -> None:
        self._pane.show_advice_ended(sentence)
