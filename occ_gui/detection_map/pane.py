"""The pane of map, limits and advice, and the controllers that measure for it."""

from dataclasses import replace

from PySide6.QtCore import QObject

from occ_gui.background.result_age import ResultAges
from occ_gui.background.signals import JobChannel
from occ_gui.core.store import NO_GESTURE
from occ_gui.detection_map.map_schedule import MapRequest
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.rate_map import PointFacts, RateMap, TheoryFields
from occ_gui.detection_map.search_controller import (
    IN_TURN_RANK,
    AdvisorController,
    MostBitsController,
)
from occ_gui.detection_map.wiring import BackgroundRates
from occ_gui.detection_map.worker import UNSEEN_PARAMETERS, find_omitted_effects
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_model.receiver.decode import DECODERS, QUICK_DECODERS
from occ_model.scene.parameters import quantity
from occ_model.study.sweep.sweep import MeasuredPoints, rate_intervals

FIRST_AXES = ("switching_frequency", "distance")


class DetectionMapController(QObject):
    def __init__(self, scenes: SceneStore, channel: JobChannel, view: MapView) -> None:
        super().__init__()
        self._scenes = scenes
        self.channel, self._view = channel, view
        bits = scenes.store.select(lambda workspace: (workspace.shown, workspace.frame_rate))
        bits.changed.connect(lambda choice: view.show_quantity(*choice))
        self._axes = FIRST_AXES
        self._with_image_effects = True
        self._is_visible = False
        self._last_request: MapRequest | None = None
        self._map_request: MapRequest | None = None
        self._awaited_request: MapRequest | None = None
        self.map: RateMap | None = None
        self._ages = ResultAges(self._request())
        channel.results_ready.connect(self._enter_results)
        channel.finished.connect(self._finish)
        channel.failed.connect(self._fail)
        channel.status_message.connect(view.show_failure)
        for store in (scenes, scenes.settings):
            store.changed.connect(self._follow_change)

    @property
    def awaits_first_points(self) -> bool:
        """Whether the first points of a map are being measured and are not slow; thread-safe."""
        return self._awaited_request is not None

    @property
    def is_current(self) -> bool:
        return self.map is not None and self._map_request == self._request()

    @property
    def complete(self) -> tuple[RateMap, MapRequest] | None:
        """The map and its request; None while points or images of them are missing."""
        if self.map is None or self._map_request is None or not self.is_current:
            return None
        return None if self.map.find_doubtful().any() else (self.map, self._map_request)

    def _request(self) -> MapRequest:
        x, y = self._axes
        defaults = {name: quantity(name).default for name in self._axes}
        scene = self._scenes.seen.replace(**{**UNSEEN_PARAMETERS, **defaults})
        return MapRequest(scene, x, y, self._scenes.settings.settings, self._with_image_effects)

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        if visible:
            self._follow_change()
        else:
            self._stop()

    def choose_axes(self, x: str, y: str) -> None:
        """Set the axes; if the user chooses the parameter of the other axis, the axes swap."""
        old_x, old_y = self._axes
        if x == y:
            x, y = (x, old_x) if x == old_y else (old_y, y)
        self._axes = (x, y)
        self._view.show_axes(x, y)
        self._follow_change()

    def use_image_effects(self, used: bool) -> None:
        """Set whether image effects are simulated or left out."""
        self._with_image_effects = used
        self._follow_change()

    def _follow_change(self) -> None:
        if not self._is_visible:
            return
        self._view.show_scene(self._scenes.seen)
        self._show_omissions()
        request = self._request()
        self._ages.begin(request)
        self._show_age()
        if request == self._last_request:
            return
        self._last_request = request
        self._view.show_failure("")
        known_map = self.map if request == self._map_request else None
        rates = request.make_empty_map() if known_map is None else known_map
        self._awaited_request = request if known_map is None else None
        jobs = request.jobs(rates.images.copy(), rates.theory is None)
        self.channel.put(request, jobs)

    def _show_omissions(self) -> None:
        scene, settings = self._scenes.seen, self._scenes.settings.settings
        self._view.show_omissions(
            () if self._with_image_effects else find_omitted_effects(scene, settings)
        )

    def _end_wait(self, request: MapRequest) -> None:
        if self._awaited_request is request:
            self._awaited_request = None

    def _enter_results(
        self, request: MapRequest, results: list[MeasuredPoints | TheoryFields]
    ) -> None:
        self._end_wait(request)
        if request != self._map_request or self.map is None:
            self.map, self._map_request = request.make_empty_map(), request
        for result in results:
            if isinstance(result, TheoryFields):
                self.map.theory = result
            else:
                self.map.enter(result.points, result.images, result.first)
        self._show_age()
        self._view.show_map(self.map)
        self._show_progress()

    def _show_age(self) -> None:
        self._view.show_age(0.0 if self._map_request is None else self._ages.age(self._map_request))

    def _show_progress(self) -> None:
        assert self.map is not None  # noqa: S101 - it is called when there is a map
        rates = self.map
        self._view.show_progress(
            rates.known_count, rates.images.size, rates.least_images, rates.enough_images
        )

    def _finish(self, request: MapRequest) -> None:
        if request == self._map_request:
            self._show_progress()

    def _fail(self, sentence: str) -> None:
        self._awaited_request = None
        self._view.show_failure(sentence)

    def _stop(self) -> None:
        self.channel.cancel()
        self._last_request = self._awaited_request = None

    def point_at(self, place: tuple[int, int] | None) -> None:
        """Show what is known about a point, given by its indices along both axes."""
        rates = self.map
        x, y = -1, -1
        if place is not None and rates is not None:
            x, y = (int(source[place]) for source in rates.find_rate_sources())
        if rates is None or x < 0:
            self._view.show_facts(None)
            return
        point, images = rates.point(x * rates.shape[1] + y), int(rates.images[x, y])
        counts = tuple(
            (name, count, low, high)
            for name, count, (low, high) in zip(
                rates.decoders, point.right, rate_intervals(point, images), strict=True
            )
        )
        most_bits = float(rates.most_bits(self._scenes.store.workspace.frame_rate)[x, y])
        self._view.show_facts(
            PointFacts(
                rates.x_values[x], rates.y_values[y], counts, point.sent, images, point.note,
                point.whole, most_bits,
            )
        )  # fmt: skip

    def go_to(self, place: tuple[int, int]) -> None:
        """Set the scene to a point, given by its indices along both axes, in one undo step."""
        rates = self.map
        if rates is not None:
            x, y = place
            changes = {rates.x: rates.x_values[x], rates.y: rates.y_values[y]}
            self._scenes.change(NO_GESTURE, **changes)


class MapPane(Pane[None]):
    """The map, and the searches for limits, which go on while the pane is hidden."""

    def __init__(self, scenes: SceneStore, background_rates: BackgroundRates) -> None:
        view = MapView(QUICK_DECODERS, tuple(DECODERS))
        super().__init__(view)
        self.view = view
        store, queue = scenes.store, background_rates.queue
        channels = tuple(map(background_rates.channel, ("map", "advice", "most bits")))
        self.map = DetectionMapController(scenes, channels[0], view)
        self.advisor = AdvisorController(scenes, queue, channels[1], view.advice)
        self.most_bits = MostBitsController(scenes, queue, channels[2], view.most_bits)
        self.measures = channels
        view.axes_chosen.connect(self.map.choose_axes)
        view.plots.picked.connect(self.map.go_to)
        view.plots.pointed.connect(self.map.point_at)
        view.quantity.chosen.connect(lambda key: store.put(replace(store.workspace, shown=key)))
        view.frame_rate.edited.connect(
            lambda rate: store.put(replace(store.workspace, frame_rate=rate))
        )
        rate = store.select(lambda workspace: workspace.frame_rate)
        rate.changed.connect(view.advice.use_frame_rate)
        view.advice.use_frame_rate(rate.value)  # another pane may have changed it
        view.show_quantity(store.workspace.shown, rate.value)
        view.image_effects.toggled.connect(self.map.use_image_effects)
        view.image_effects.toggled.connect(self.advisor.use_image_effects)
        view.advice.search_requested.connect(self.advisor.start)
        view.advice.cards.search_requested.connect(lambda: self.advisor.start(IN_TURN_RANK))
        view.advice.cancelled.connect(self.advisor.cancel)
        view.advice.destination_chosen.connect(self.advisor.go_to_limit)
        view.most_bits.search_requested.connect(self.most_bits.start)
        view.most_bits.cancelled.connect(self.most_bits.cancel)
        view.most_bits.chosen.connect(self.most_bits.go)

    def set_visible(self, visible: bool) -> None:
        self.map.set_visible(visible)
