"""Find out how fast a scene can go, when the user asks."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QObject, QTimer

from occ_gui.background.crew import Crew, Lane
from occ_gui.background.parcel import Parcel, Stage
from occ_gui.detection_map.worker import advise, rate_settings
from occ_gui.scene.gesture import NO_GESTURE
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import SettingsStore
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
"""Somebody waits for it: it goes before all that is measured unasked."""


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
        """Give one parcel a decoder."""
        parcels = []
        for slot, decoder in enumerate(DECODERS):
            settings = rate_settings(self.settings, IMAGES, (decoder,), self.with_image_effects)
            parcels.append(Parcel(advise, (self.scene, settings, decoder, RATE), slot + 1))
        yield Stage(_RANK, tuple(parcels))


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
    crew, lane
        Do the work.
    pane
        Shows what is found.
    """

    def __init__(
        self,
        scenes: SceneStore,
        settings: SettingsStore,
        crew: Crew,
        lane: Lane,
        pane: AdvicePane,
    ) -> None:
        super().__init__()
        self._scenes, self._settings = scenes, settings
        self._crew, self._lane, self._pane = crew, lane, pane
        self._with_image_effects = False
        self._counted = 0
        self._look = QTimer(self)
        self._look.setInterval(_LOOK_MS)
        self._look.timeout.connect(self._tell_progress)
        lane.came.connect(self._take)
        lane.finished.connect(lambda _request: self._end(""))
        lane.failed.connect(self._end)
        for store in (scenes, settings):
            store.changed.connect(self._move_on)

    @property
    def is_idle(self) -> bool:
        """Whether nothing is being searched."""
        return self._lane.is_idle

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
        self._lane.put(request, request.stages)
        self._look.start()

    def cancel(self) -> None:
        """Search no more."""
        if not self._lane.is_idle:
            self._lane.cancel()
            self._end(self.tr("Cancelled."))

    def take_there(self, name: str, value: float) -> None:
        """Take the scene to a limit, in one step."""
        self._scenes.change(NO_GESTURE, **{name: value})

    def _count(self) -> int:
        return sum(self._crew.counted(slot + 1) for slot in range(len(DECODERS)))

    def _tell_progress(self) -> None:
        share = (self._count() - self._counted) / (_USUAL * IMAGES * len(DECODERS))
        self._pane.show_advice_progress(min(share, 0.99))

    def _take(self, _request: AdviceRequest, results: list[Advice]) -> None:
        for advice in results:
            self._pane.show_advice(advice)

    def _move_on(self) -> None:
        if self._lane.is_idle:
            self._pane.show_advice_outdated()
        else:
            self._lane.cancel()
            self._end(self.tr("The scene has changed; ask again."))

    def _end(self, sentence: str) -> None:
        self._look.stop()
        self._pane.show_advice_ended(sentence)
