"""Find out how fast a scene can go, when the user asks."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QObject, QTimer

from occ_gui.background.signals import JobChannel, WorkQueue
from occ_gui.detection_map.worker import advise, rate_settings
from occ_gui.scene.gesture import NO_GESTURE
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import SettingsStore
from occ_model.parallel.job import Job, Stage
from occ_model.receiver.decoders import DECODERS
from occ_model.results.advice import Advice
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

RATE = 99.0
"""Percent of the bits from which a decoder counts as reading."""

IMAGES = 20
"""At each value that is tried."""

_USUAL = 95
"""Values that a search tries as a rule: the progress is told by it."""

_LOOK_MS = 100

_RANK = -1
"""Below all others: somebody waits for it."""


@dataclass(frozen=True, slots=True)
class AdviceRequest:
    """All that the advice depends on.

    Parameters
    ----------
    scene
        The scene.
    settings
        How the window simulates.
    with_image_effects
        Whether whole images are made where the scene calls for them.
    """

    scene: Scene
    settings: SimulationSettings
    with_image_effects: bool

    def stages(self) -> Iterator[Stage]:
        """Give one job for each decoder."""
        jobs = []
        for counter, decoder in enumerate(DECODERS, 1):
            settings = rate_settings(self.settings, IMAGES, (decoder,), self.with_image_effects)
            jobs.append(Job(advise, (self.scene, settings, decoder, RATE), counter))
        yield Stage(_RANK, tuple(jobs))


class AdvicePane(Protocol):
    """A pane that shows advice."""

    def show_advice_begun(self) -> None:
        """Tell that advice is on its way."""

    def show_advice_progress(self, share: float) -> None:
        """Tell how much of the search is done, from 0 to 1."""

    def show_advice(self, advice: Advice) -> None:
        """Show how far one decoder reaches."""

    def show_advice_ended(self, sentence: str) -> None:
        """Tell that no more comes, and why, unless all has come."""

    def show_advice_outdated(self) -> None:
        """Tell that the scene is another one now."""


class AdvisorController(QObject):
    """Connects the stores, the processes and the pane.

    Parameters
    ----------
    scenes, settings
        What is searched.
    queue, channel
        Do the work.
    pane
        Shows what is found.
    """

    def __init__(
        self,
        scenes: SceneStore,
        settings: SettingsStore,
        queue: WorkQueue,
        channel: JobChannel,
        pane: AdvicePane,
    ) -> None:
        super().__init__()
        self._scenes, self._settings = scenes, settings
        self._queue, self._channel, self._pane = queue, channel, pane
        self._with_image_effects = False
        self._counted = 0
        self._look = QTimer(self)
        self._look.setInterval(_LOOK_MS)
        self._look.timeout.connect(self._tell_progress)
        channel.results_ready.connect(self._take)
        channel.finished.connect(lambda _request: self._end(""))
        channel.failed.connect(self._end)
        for store in (scenes, settings):
            store.changed.connect(self._move_on)

    @property
    def is_idle(self) -> bool:
        """Whether nothing is being searched."""
        return self._channel.is_idle

    def use_image_effects(self, wanted: bool) -> None:
        """Make whole images where the scene calls for them, or leave out what needs them."""
        self._with_image_effects = wanted

    def start(self) -> None:
        """Search for the limits of the scene as it is now."""
        request = AdviceRequest(
            self._scenes.scene, self._settings.settings, self._with_image_effects
        )
        self._counted = self._count()
        self._pane.show_advice_begun()
        self._channel.put(request, request.stages)
        self._look.start()

    def cancel(self) -> None:
        """Search no more."""
        if not self._channel.is_idle:
            self._channel.cancel()
            self._end(self.tr("Cancelled."))

    def take_there(self, name: str, value: float) -> None:
        """Take the scene to a limit, in one step."""
        self._scenes.change(NO_GESTURE, **{name: value})

    def _count(self) -> int:
        return sum(self._queue.counted(counter) for counter, _ in enumerate(DECODERS, 1))

    def _tell_progress(self) -> None:
        share = (self._count() - self._counted) / (_USUAL * IMAGES * len(DECODERS))
        self._pane.show_advice_progress(min(share, 0.99))

    def _take(self, _request: AdviceRequest, results: list[Advice]) -> None:
        for advice in results:
            self._pane.show_advice(advice)

    def _move_on(self) -> None:
        if self._channel.is_idle:
            self._pane.show_advice_outdated()
        else:
            self._channel.cancel()
            self._end(self.tr("The scene has changed; ask again."))

    def _end(self, sentence: str) -> None:
        self._look.stop()
        self._pane.show_advice_ended(sentence)
