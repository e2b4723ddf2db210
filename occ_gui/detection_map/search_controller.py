"""Controllers of searches that the user starts: the limits of a scene, and the most bits."""

from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QObject, QTimer

from occ_gui.background.signals import JobChannel, WorkQueue
from occ_gui.core.store import NO_GESTURE
from occ_gui.detection_map.advice_view import AdviceView
from occ_gui.detection_map.advice_worker import (
    RoughAnswer,
    advise,
    advise_roughly,
    search_most_bits,
)
from occ_gui.detection_map.most_bits_card import MostBitsCard
from occ_gui.detection_map.worker import find_omitted_effects, make_rate_settings
from occ_gui.scene.scene_store import SceneStore
from occ_model.parallel.job import Job
from occ_model.receiver.decode import DECODERS
from occ_model.results.bit_errors import MostBits
from occ_model.results.limits import Advice
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study import most_bits
from occ_model.study.limits import SEARCHED_PARAMETERS
from occ_model.study.working_range import READ_RATE, estimate_range_images

IMAGES = 20

_USUAL_IMAGES = len(SEARCHED_PARAMETERS) * estimate_range_images(IMAGES)
"""Usual number of images in a decoder's search, from which its progress is estimated."""

_ADVICE_COUNTERS = range(1, len(DECODERS) + 1)
_MOST_COUNTER = len(DECODERS) + 1  # counter of the pictures tried in the search for most bits

PROGRESS_MS = 100

FIRST_RANK, IN_TURN_RANK = -1, 3
"""Priorities: before all else if the user asks; otherwise after all points of a visible map, but
before more images of them."""


class SearchController(QObject):
    """Searches in the background, reports progress, and stops when the scene changes.

    A subclass returns the present request from :meth:`_request`.
    """

    cancel_text = change_text = ""  # shown after the user, or a change, has ended a search

    def __init__(
        self,
        scenes: SceneStore,
        queue: WorkQueue,
        channel: JobChannel,
        counters: Sequence[int],
        show_result: Callable[[Any], None],
        show_end: Callable[[str], None],
    ) -> None:
        super().__init__()
        self._scenes, self._queue, self.channel = scenes, queue, channel
        self._counters, self._show_result, self._show_end = counters, show_result, show_end
        self._last_request: Any = None
        self._result_count = 0
        self._start_counts = [0] * len(counters)
        self._timer = QTimer(self)
        self._timer.setInterval(PROGRESS_MS)
        self._timer.timeout.connect(self._check_progress)
        channel.results_ready.connect(self._show_results)
        channel.finished.connect(self._finish)
        channel.failed.connect(self._show_end)
        scenes.changed.connect(self._follow_change)

    def _begin(self, request: Any, jobs: Iterator[Job]) -> None:
        self._last_request, self._result_count = request, 0
        self._start_counts = self._count_heartbeats()
        self.channel.put(request, jobs)
        self._timer.start()
        self._check_progress()

    def _go_to(self, decoder: str, changes: Mapping[str, ParameterValue]) -> None:
        """Set the scene to a result in one undo step, and show what its decoder reads."""
        self._scenes.change(NO_GESTURE, **changes)
        store = self._scenes.store
        store.put(replace(store.workspace, decoder=decoder))

    def cancel(self) -> None:
        """Stop the search; its results so far stay."""
        if not self.channel.is_idle:
            self.channel.cancel()
            self._show_end(self.cancel_text)

    def _follow_change(self) -> None:
        if self._last_request is None:
            return
        is_outdated = self._request() != self._last_request
        if is_outdated and not self.channel.is_idle:
            self.channel.cancel()
            self._show_end(self.change_text)
        self._show_outdated(is_outdated)

    def _finish(self, _request: object) -> None:
        self._show_end("")

    def _count_heartbeats(self) -> list[int]:
        return [self._queue.count_heartbeats(counter) for counter in self._counters]

    def _check_progress(self) -> None:
        if self.channel.is_idle:
            self._timer.stop()
        else:
            pairs = zip(self._count_heartbeats(), self._start_counts, strict=True)
            self._show_progress([now - start for now, start in pairs])

    def _show_results(self, _request: object, results: list[Any]) -> None:
        self._result_count += len(results)
        for result in results:
            self._show_result(result)

    def _request(self) -> Any:
        raise NotImplementedError

    def _show_progress(self, heartbeats: Sequence[int]) -> None:
        """Show what each counter has counted: pictures, and each job once when it begins."""
        raise NotImplementedError

    def _show_outdated(self, outdated: bool) -> None:
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class AdviceRequest:
    scene: Scene
    settings: SimulationSettings
    with_image_effects: bool

    def omit_value(self, name: str) -> "AdviceRequest":
        """Return the request without the value of a parameter that its limits do not depend on."""
        scene = self.scene.replace(**{name: quantity(name).default})
        return replace(self, scene=scene)

    def jobs(self, rank: int, found: Set[str] = frozenset()) -> Iterator[Job]:
        """Yield rough searches of all decoders but those found, and then the thorough ones."""
        for function in (advise_roughly, advise):
            for counter, decoder in zip(_ADVICE_COUNTERS, DECODERS, strict=True):
                if decoder in found:
                    continue
                settings = make_rate_settings(
                    self.settings, IMAGES, (decoder,), self.with_image_effects
                )
                yield Job(function, (self.scene, settings, decoder, READ_RATE), counter, rank)


class AdvisorController(SearchController):
    cancel_text, change_text = "Cancelled.", "The scene has changed; ask again."

    def __init__(
        self, scenes: SceneStore, queue: WorkQueue, channel: JobChannel, pane: AdviceView
    ) -> None:
        callbacks = self._show_answer, pane.show_advice_ended
        super().__init__(scenes, queue, channel, _ADVICE_COUNTERS, *callbacks)
        self._pane = pane
        self._with_image_effects = True
        # The priority of the last search, and the decoders whose limits it has found
        self._rank, self._found = FIRST_RANK, set[str]()
        scenes.settings.changed.connect(self._follow_change)

    def _show_answer(self, answer: Advice | RoughAnswer) -> None:
        if isinstance(answer, RoughAnswer):
            self._pane.show_rough(answer.decoder, answer.frequencies)
        else:
            self._found.add(answer.limits.decoder)
            self._pane.show_advice(answer)

    def use_image_effects(self, used: bool) -> None:
        """Set whether image effects are simulated or left out."""
        self._with_image_effects = used
        self._follow_change()

    def _request(self) -> AdviceRequest:
        settings = self._scenes.settings.settings
        return AdviceRequest(self._scenes.seen, settings, self._with_image_effects)

    def start(self, rank: int = FIRST_RANK) -> None:
        """Search for the limits of the present scene; what is found of them stays."""
        request = self._request()
        if request == self._last_request and not self.channel.is_idle:
            if rank < self._rank:
                self.channel.cancel()
                self._rank = rank
                self._begin(request, request.jobs(rank, frozenset(self._found)))
            return
        self._rank, self._found = rank, set()
        omitted_effects = (
            ()
            if self._with_image_effects
            else find_omitted_effects(request.scene, request.settings)
        )
        self._pane.show_advice_begun(omitted_effects)
        self._begin(request, request.jobs(rank))

    def go_to_limit(self, name: str, value: float, decoder: str) -> None:
        self._go_to(decoder, {name: value})

    def _show_progress(self, heartbeats: Sequence[int]) -> None:
        fraction = min(sum(heartbeats) / (_USUAL_IMAGES * len(DECODERS)), 0.99)
        # Both jobs of a decoder count once when they begin; pictures of the rough one do not.
        tried = [max(count - 2, 0) if count else None for count in heartbeats]
        self._pane.show_advice_progress(fraction, dict(zip(DECODERS, tried, strict=True)))

    def _show_outdated(self, outdated: bool) -> None:
        last, present = self._last_request, self._request()
        valid_parameters = [
            name
            for name in SEARCHED_PARAMETERS
            if last.omit_value(name) == present.omit_value(name)
        ]
        self._pane.show_advice_outdated(outdated, frozenset(valid_parameters))


@dataclass(frozen=True, slots=True)
class MostBitsRequest:
    scene: Scene
    frames_a_second: float

    def jobs(self) -> Iterator[Job]:
        for decoder in most_bits.DECODERS:
            arguments = (self.scene, decoder, self.frames_a_second)
            yield Job(search_most_bits, arguments, _MOST_COUNTER, FIRST_RANK)


class MostBitsController(SearchController):
    """Searches for the code, frequency and number of bits that carry most bits a second."""

    cancel_text, change_text = "cancelled", "the scene has changed"

    def __init__(
        self, scenes: SceneStore, queue: WorkQueue, channel: JobChannel, pane: MostBitsCard
    ) -> None:
        callbacks = pane.show_result, pane.show_ended
        super().__init__(scenes, queue, channel, [_MOST_COUNTER], *callbacks)
        self._pane = pane
        frame_rate = scenes.store.select(lambda workspace: workspace.frame_rate)
        frame_rate.changed.connect(self._follow_change)

    def _request(self) -> MostBitsRequest:
        workspace = self._scenes.store.workspace
        return MostBitsRequest(most_bits.reset_varied(self._scenes.seen), workspace.frame_rate)

    def start(self) -> None:
        """Search at the exposure and the distance of the present scene."""
        request = self._request()
        self._pane.show_begun()
        self._begin(request, request.jobs())

    def go(self, result: MostBits) -> None:
        scene = most_bits.make_example(result)
        if scene is not None:
            changes = {name: scene.value(name) for name in most_bits.VARIED_PARAMETERS}
            self._go_to(result.decoder, changes)

    def _show_progress(self, heartbeats: Sequence[int]) -> None:
        if self._result_count < len(most_bits.DECODERS):
            tried = sum(heartbeats) - self._result_count - 1
            decoder = most_bits.DECODERS[self._result_count]
            self._pane.show_progress(decoder, tried if tried >= 0 else None)

    def _show_outdated(self, outdated: bool) -> None:
        self._pane.show_outdated(outdated)
