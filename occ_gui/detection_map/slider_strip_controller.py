"""Success rates along each main slider, and of the present scene, once it no longer changes."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from occ_gui.background.result_age import PAUSE
from occ_gui.background.signals import JobChannel
from occ_gui.detection_map.rate_map import make_lattice
from occ_gui.detection_map.slider_strip import IMAGES, SceneRate, SliderStrips
from occ_gui.detection_map.worker import (
    UNSEEN_PARAMETERS,
    StripPoints,
    make_rate_settings,
    measure_strip,
)
from occ_gui.scene.scene_store import SceneStore
from occ_model.parallel.job import Job
from occ_model.results.sweep_request import SweepPoint
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.sweep.sweep import MeasuredPoints, measure_points


@dataclass(frozen=True, slots=True)
class RateRequest:
    scene: Scene
    settings: SimulationSettings
    decoder: str

    def omit_value(self, name: str) -> "RateRequest":
        """Return the request for the strip of a slider, without the value of that slider."""
        defaults = {**UNSEEN_PARAMETERS, name: quantity(name).default}
        return replace(self, scene=self.scene.replace(**defaults))


class RateController(QObject):
    """Measures success rates for the present scene, settings and decoder while they are visible.

    A subclass compares the present request with the last one in :meth:`_follow_change`, puts jobs
    into the channel in :meth:`_measure`, and handles their results in :meth:`_show_results`.
    """

    def __init__(self, scenes: SceneStore, channel: JobChannel) -> None:
        super().__init__()
        self._scenes, self._channel = scenes, channel
        self._is_visible = False
        self._last_request: RateRequest | None = None
        self._rest_timer = QTimer(self, singleShot=True)
        self._rest_timer.setInterval(round(1e3 * PAUSE))
        self._rest_timer.timeout.connect(self._measure)
        channel.results_ready.connect(self._show_results)
        for store in (scenes, scenes.settings):
            store.changed.connect(self._follow_change)
        decoder = scenes.store.select(lambda workspace: workspace.decoder)
        decoder.changed.connect(self._follow_change)

    @property
    def is_idle(self) -> bool:
        return self._channel.is_idle and not self._rest_timer.isActive()

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        if visible:
            self._follow_change()
        else:
            self._rest_timer.stop()
            self._channel.cancel()
            self._reset()

    def _reset(self) -> None:
        self._last_request = None

    def _request(self) -> RateRequest:
        decoder = self._scenes.store.workspace.decoder
        return RateRequest(self._scenes.seen, self._scenes.settings.settings, decoder)

    def _follow_change(self) -> None:
        raise NotImplementedError

    def _measure(self) -> None:
        raise NotImplementedError

    def _show_results(self, request: RateRequest, results: list[Any]) -> None:
        raise NotImplementedError


POSITIONS = 29

STRIDES = (4, 1)  # distances between measured positions: a coarse strip first, then every position
RANK = 3  # after all points of a visible map, but before more images of them


def make_strip_jobs(missing: Mapping[str, tuple[RateRequest, set[int]]]) -> Iterator[Job]:
    """Yield the remaining jobs."""
    scheduled: set[int] = set()
    for stride in STRIDES:
        new = set(range(0, POSITIONS, stride)) - scheduled
        scheduled |= new
        for name, (request, places) in missing.items():
            if group := sorted(new & places):
                job = _make_job(request, name, group)
                yield replace(job, uninterruptible=stride == STRIDES[0])


def _make_job(request: RateRequest, name: str, places: list[int]) -> Job:
    settings = make_rate_settings(request.settings, IMAGES, (request.decoder,), True)
    values = make_lattice(name, POSITIONS)
    points = tuple((place, {name: values[place]}) for place in places)
    return Job(measure_strip, (request.scene, settings, name, points), rank=RANK)


class SliderStripController(RateController):
    """Connects the stores, the job channel and the strips.

    The strip of a slider does not change while that slider is moved. The other strips are measured
    once it rests; until then, the processor is free for the picture that follows the slider.
    """

    def __init__(self, scenes: SceneStore, channel: JobChannel, pane: SliderStrips) -> None:
        self._pane = pane
        self._known: dict[str, tuple[RateRequest, dict[int, float | None]]] = {}
        self._missing: dict[str, tuple[RateRequest, set[int]]] = {}
        super().__init__(scenes, channel)

    def _follow_change(self) -> None:
        if not self._is_visible:
            return
        request = self._request()
        if request == self._last_request:
            return
        is_first, self._last_request = self._last_request is None, request
        for name in self._pane.strips:
            strip_request = request.omit_value(name)
            known = self._known.get(name)
            is_present = known is not None and known[0] == strip_request
            self._pane.strips[name].show_outdated(known is not None and not is_present)
            places = set(known[1]) if known is not None and is_present else set()
            self._missing[name] = (strip_request, set(range(POSITIONS)) - places)
        if is_first:
            self._measure()
        else:
            self._rest_timer.start()

    def _measure(self) -> None:
        request = self._last_request
        if request is not None:
            missing, self._missing = self._missing, {}
            self._channel.put(request, make_strip_jobs(missing))

    def _show_results(self, request: RateRequest, results: list[StripPoints]) -> None:
        for result in results:
            strip_request = request.omit_value(result.name)
            known = self._known.get(result.name)
            if known is None or known[0] != strip_request:
                known = self._known[result.name] = (strip_request, {})
            known[1].update({point.index: fraction_of(point) for point in result.points})
        for name in {result.name for result in results}:
            strip_request, fractions = self._known[name]
            strip = self._pane.strips[name]
            strip.show_outdated(strip_request != self._request().omit_value(name))
            strip.show_fractions(
                tuple(_find_nearest(fractions, place) for place in range(POSITIONS))
            )


def fraction_of(point: SweepPoint) -> float | None:
    """Return the fraction of bits read; None if the point is refused or a plug-in has failed."""
    return None if point.note else point.right[0] / point.sent


def _find_nearest(fractions: Mapping[int, float | None], place: int) -> float | None:
    """Return the fraction at a position, or else at its neighbour on the coarser lattice."""
    if place in fractions:
        return fractions[place]
    return fractions.get(round(place / STRIDES[0]) * STRIDES[0])


SCENE_IMAGES = 20  # pictures from which the rate is computed, as many as for the limits
SCENE_RANK = 1  # after the first points of the map, before all else


class SceneRateController(RateController):
    """Measures the rate of the present scene once it no longer changes, while it is visible."""

    changed = Signal(object)  # the rate, an :class:`SceneRate`; None if unknown

    def __init__(self, scenes: SceneStore, channel: JobChannel) -> None:
        super().__init__(scenes, channel)
        self.rate: SceneRate | None = None

    def _reset(self) -> None:
        super()._reset()
        self._show(None)

    def _show(self, rate: SceneRate | None) -> None:
        if rate != self.rate:
            self.rate = rate
            self.changed.emit(rate)

    def _follow_change(self) -> None:
        present = self._request()
        request = replace(present, scene=present.scene.replace(**UNSEEN_PARAMETERS))
        if not self._is_visible or request == self._last_request:
            return
        self._channel.cancel()
        self._reset()
        self._last_request = request
        self._rest_timer.start()

    def _measure(self) -> None:
        if self._last_request is not None:
            self._channel.put(self._last_request, iter([make_scene_rate_job(self._last_request)]))

    def _show_results(self, request: RateRequest, results: list[MeasuredPoints]) -> None:
        if request == self._last_request and results:
            self._show(compute_scene_rate(results[-1]))


def make_scene_rate_job(request: RateRequest) -> Job:
    settings = make_rate_settings(request.settings, SCENE_IMAGES, (request.decoder,), True)
    return Job(measure_points, (request.scene, settings, ((0, {}),), 0), rank=SCENE_RANK)


def compute_scene_rate(measured: MeasuredPoints) -> SceneRate | None:
    """Return the rate of a single point; None if it is refused or a plug-in has failed."""
    (point,) = measured.points
    if point.note:
        return None
    low, high = interval_of_pictures(point.right[0], point.sent, measured.images)
    fraction, (whole,) = point.right[0] / point.sent, point.whole
    return SceneRate(fraction, low / 100.0, high / 100.0, measured.images, whole)
