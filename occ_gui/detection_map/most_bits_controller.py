"""Controller of the search for what carries most: in the background, when the user asks for it."""

from collections.abc import Iterator
from dataclasses import dataclass

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.background.signals import JobChannel, WorkQueue
from occ_gui.core.store import NO_GESTURE
from occ_gui.detection_map.advice_worker import carry_most
from occ_gui.detection_map.most_bits_card import MostBitsCard
from occ_gui.scene.scene_store import SceneStore
from occ_model.parallel.job import Job, Stage
from occ_model.receiver import decoders
from occ_model.results.most_bits import MostBits
from occ_model.scene.scene import Scene
from occ_model.study.most_bits import DECODERS, VARIED, example_of, unvaried

_COUNTER = len(decoders.DECODERS) + 1
"""The counter of the pictures tried: those before are the advice's."""

_RANK = -1  # below all others: somebody waits for it, and it leaves them a process

_LOOK_MS = 200


@dataclass(frozen=True, slots=True)
class MostBitsRequest:
    scene: Scene
    frames_a_second: float

    def stages(self) -> Iterator[Stage]:
        """Return one job for each decoder, one after the other: other work keeps its process."""
        for decoder in DECODERS:
            job = Job(carry_most, (self.scene, decoder, self.frames_a_second), _COUNTER)
            yield Stage(_RANK, (job,))


class MostBitsController(QObject):
    went = Signal(str)  # the scene has become what carries most; the decoder that reads it

    def __init__(
        self,
        scenes: SceneStore,
        queue: WorkQueue,
        channel: JobChannel,
        pane: MostBitsCard,
    ) -> None:
        super().__init__()
        self._scenes, self._queue, self.channel, self._pane = scenes, queue, channel, pane
        self._asked: MostBitsRequest | None = None
        self._done = self._counted = 0
        self._look = QTimer(self)
        self._look.setInterval(_LOOK_MS)
        self._look.timeout.connect(self._show_tried)
        channel.results_ready.connect(self._take)
        channel.finished.connect(lambda _request: self._end(""))
        channel.failed.connect(self._end)
        scenes.changed.connect(self._move_on)
        frame_rate = scenes.store.select(lambda workspace: workspace.frame_rate)
        frame_rate.changed.connect(self._move_on)

    def _request(self) -> MostBitsRequest:
        workspace = self._scenes.store.workspace
        return MostBitsRequest(unvaried(workspace.scene), workspace.frame_rate)

    def start(self) -> None:
        """Search at the exposure and the distance of the current scene."""
        request = self._asked = self._request()
        self._done, self._counted = 0, self._queue.counted(_COUNTER)
        self._pane.show_begun()
        self.channel.put(request, request.stages)
        self._show_tried()
        self._look.start()

    def cancel(self) -> None:
        """Stop the search; what was found so far stays."""
        if not self.channel.is_idle:
            self.channel.cancel()
            self._end("cancelled")

    def go(self, found: MostBits) -> None:
        scene = example_of(found)
        if scene is not None:
            self._scenes.change(NO_GESTURE, **{name: scene.value(name) for name in VARIED})
            self.went.emit(found.decoder)

    def _show_tried(self) -> None:
        if self.channel.is_idle:
            self._look.stop()
        elif self._done < len(DECODERS):
            tried = self._queue.counted(_COUNTER) - self._counted
            self._pane.show_tried(DECODERS[self._done], tried)

    def _take(self, _request: MostBitsRequest, results: list[MostBits]) -> None:
        self._done += len(results)
        for found in results:
            self._pane.show_found(found)

    def _move_on(self) -> None:
        if self._asked is None:
            return
        outdated = self._request() != self._asked
        if outdated and not self.channel.is_idle:
            self.channel.cancel()
            self._end("the scene has changed")
        self._pane.show_outdated(outdated)

    def _end(self, sentence: str) -> None:
        self._pane.show_ended(sentence)
