"""The pane of the bench, and the controller that measures in the background."""

from collections.abc import Iterator
from dataclasses import replace

from PySide6.QtCore import QObject

from occ_gui.background.signals import JobChannel
from occ_gui.bench.bench_view import PUBLISHED, BenchChoice, BenchView
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import region_of
from occ_model.errors import OccError, ParameterError
from occ_model.parallel.job import Job
from occ_model.receiver.decode import decoders
from occ_model.results.bit_errors import BenchBounds, BenchPoint, BenchRequest
from occ_model.scene.scene import Scene
from occ_model.study.bench.bench import bench_bounds, bench_scene, check_bench, measure_bench_point
from occ_model.study.bit_error_rate import check_frame_rate

FIRST_DECODERS = ("threshold", "equalizer", "sequence")

_RANK = -1  # before all other work, because the user waits for it


def request_of(choice: BenchChoice, scene: Scene) -> BenchRequest:
    """Make a request for the published code, or for the scheme, bits and timing of the scene."""
    request = BenchRequest(decoders=choice.decoders, bits=choice.bits)
    if choice.code_source == PUBLISHED:
        return request
    transmitter, camera = scene.transmitter, scene.camera
    if transmitter.pattern:
        raise ParameterError("The scene sends a raw chip pattern, which has no bits to count.")
    region = region_of(panel_corners(scene), camera.rows, camera.columns)
    if region is None:
        raise ParameterError("The scene's picture shows no panel.")
    return replace(
        request,
        schemes=(f"{transmitter.line_code}/{transmitter.framing}",),
        payload_bits=transmitter.payload_length,
        preamble=transmitter.preamble,
        error_correction=transmitter.error_correction,
        rows_a_symbol=transmitter.switching_period / camera.readout_time,
        rows=region.columns,
        readout_time=camera.readout_time,
    )


def setting_of(request: BenchRequest) -> BenchRequest:
    """Return a request without decoders and number of bits, which do not make a curve outdated."""
    return replace(request, decoders=(), bits=1)


class BenchController(QObject):
    def __init__(self, scenes: SceneStore, channel: JobChannel, view: BenchView) -> None:
        super().__init__()
        self._scenes = scenes
        self._frame_rate = scenes.store.select(lambda workspace: workspace.frame_rate)
        self.channel, self._view = channel, view
        self._choice = BenchChoice()
        self._request: BenchRequest | None = None
        self._points: list[BenchPoint] = []
        channel.results_ready.connect(self._enter_results)
        channel.finished.connect(self._finish)
        channel.failed.connect(view.show_ended)
        scenes.changed.connect(self._mark_outdated)
        self._frame_rate.changed.connect(self._show_frame_rate)
        view.show_frame_rate(self._frame_rate.value, "")

    @property
    def complete(self) -> tuple[BenchRequest, tuple[BenchPoint, ...]] | None:
        """The request and all its points; None while points are missing."""
        request = self._request
        total = 0 if request is None else len(request.points) * len(request.decoders)
        if request is None or len(self._points) != total:
            return None
        return request, tuple(self._points)

    def choose(self, choice: BenchChoice) -> None:
        """Set what is measured next; mark results that belong to another choice."""
        self._choice = choice
        self._mark_outdated()

    def start(self) -> None:
        self.channel.cancel()
        try:
            request = request_of(self._choice, self._scenes.seen)
            check_bench(request)
        except OccError as refusal:
            self._view.show_ended(str(refusal))
            return
        if not request.decoders:
            self._view.show_ended("No decoder is chosen.")
            return
        self._request, self._points = request, []
        self._view.show_begun(request)
        self._view.show_progress(0, len(request.points))
        self._show_frame_rate()
        self._mark_outdated()
        self.channel.put(request, self._jobs(request))

    @staticmethod
    def _jobs(request: BenchRequest) -> Iterator[Job]:
        yield Job(bench_bounds, (request,), rank=_RANK)
        for place in request.points:
            yield Job(measure_bench_point, (request, place), rank=_RANK)

    def cancel(self) -> None:
        """Stop the measurement; the points measured so far stay."""
        if not self.channel.is_idle:
            self.channel.cancel()
            self._view.show_ended("Cancelled: some points are missing.")

    def _enter_results(
        self, request: BenchRequest, results: list[BenchBounds | tuple[BenchPoint, ...]]
    ) -> None:
        if request != self._request:
            return
        for result in results:
            if isinstance(result, BenchBounds):
                self._view.show_bounds(result)
            else:
                self._points += result
        order = {place: number for number, place in enumerate(request.points)}
        self._points.sort(key=lambda p: order[p.scheme, p.axis, p.exposure, p.decibels])
        self._view.show_points(self._points)
        self._view.show_progress(len(self._points) // len(request.decoders), len(request.points))

    def _finish(self, _request: BenchRequest) -> None:
        self._view.show_ended("")

    def _show_frame_rate(self) -> None:
        refusal, request = "", self._request
        try:
            if request is not None:
                check_frame_rate(bench_scene(request, request.schemes[0]), self._frame_rate.value)
        except OccError as error:
            refusal = str(error)
        self._view.show_frame_rate(self._frame_rate.value, refusal)

    def _mark_outdated(self) -> None:
        if self._request is None:
            return
        try:
            request = request_of(self._choice, self._scenes.seen)
        except OccError:
            self._view.show_outdated(True)
            return
        self._view.show_outdated(setting_of(request) != setting_of(self._request))


class BenchPane(Pane[None]):
    """The view with its controller; a measurement goes on while the pane is hidden."""

    def __init__(self, scenes: SceneStore, channel: JobChannel) -> None:
        view = BenchView(decoders(), FIRST_DECODERS)
        super().__init__(view)
        self.view, self.measures = view, (channel,)
        self.controller = BenchController(scenes, channel, view)
        self.controller.choose(view.choice())
        view.choice_changed.connect(self.controller.choose)
        view.frame_rate.refused.connect(self.status_message)
        view.measurement_requested.connect(self.controller.start)
        view.cancelled.connect(self.controller.cancel)
        store = scenes.store
        view.frame_rate.edited.connect(
            lambda rate: store.put(replace(store.workspace, frame_rate=rate))
        )
