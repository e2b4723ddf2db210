"""Simulation controller: simulates and decodes the scene in the background after every change.

The results of a change arrive in this order, each by a signal:

1. ``submitted``: what is shown is of an earlier scene from now on.
2. ``picture_ready`` with a Picture of some rows, a draft, where the whole one takes long; and with
   it, so that both are painted at once, ``reading_shown`` with a Reading: the profile, the band
   model and the verdict of every decoder. It is read by the profile path, without a pixel; of
   scenes whose rows differ (a lens, a file, a panel that is not level), from the draft. While the
   scene goes on changing, it begins again at 1.
3. ``picture_ready`` with the exact Picture, before it is decoded. Where there is no draft, the
   Reading comes with it; or before it, where the picture is small but not there at once.
4. ``snapshot_ready``, ``reading_shown`` and ``snapshot_shown`` with the Snapshot, which was read
   from that picture. It is a Reading, too, and has the last word. Where a decoder has not read it,
   the same come again once it is known why.

A reading is never replaced by one of an earlier scene. ``failed`` says why a scene has no picture.
"""

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

from PySide6.QtCore import QObject, Signal

from occ_gui.background.result_age import ResultAges
from occ_gui.background.task import Task, TaskReporter
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.jobs import (
    DraftRows,
    draft_of,
    explained,
    is_soon,
    reading_by_profile,
    reading_of_draft,
    snapshot_of,
)
from occ_gui.simulation.snapshot import SOURCES, Picture, Reading, Snapshot
from occ_gui.simulation.verdict import unread_by
from occ_gui.values.simulated import LEAST_DRAFT_STEP, SimulationRequest
from occ_model.receiver.decoders import QUICK_DECODERS
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.simulation.render import plan_scene, render_with

_REST_TIME = 0.05  # seconds without a change after which the exact picture is begun

_LONGEST_PAINT = 0.1  # longest time, in seconds, for which work waits for the window to paint

CHECK_SECONDS, _MOST_CHECKS = 0.005, 20
"""Seconds between two checks whether the exact picture may begin, and the most checks."""


def _go_on() -> None:
    """Give way to nothing."""


def simulate(scene: Scene, settings: SimulationSettings = FIRST_SETTINGS) -> Snapshot:
    """Simulate a scene and decode its picture; raises ParameterError or ProjectionError."""
    request = SimulationRequest(scene, settings)
    return explained(snapshot_of(request, render_with(scene, settings)))


class SimulationController(QObject):
    """Connects stores, thread and panes; simulates the scene after every change."""

    picture_ready = Signal(object)
    """The Picture of a scene, before it is decoded; its Reading, if any, is shown already."""

    reading_shown = Signal(object)
    """The Reading that the panes show from now on; a Snapshot where it is the picture's."""

    snapshot_ready = Signal(object)  # the Snapshot of a picture that has been decoded
    snapshot_shown = Signal(object)  # the same, once the panes show it
    failed = Signal(str)  # the reason why a scene has no picture; the panes keep the last one
    failed_for = Signal(str, object)  # the same, and the names of the parameters that it is about

    submitted = Signal()  # the scene or a setting has changed: the last results are outdated

    def __init__(self, scenes: SceneStore) -> None:
        super().__init__()
        self._scenes = scenes
        self._read: Reading | None = None
        self._rows_per_pixel: Callable[[], float] = lambda: float(LEAST_DRAFT_STEP)
        self._draft_rows = DraftRows()
        self._more: tuple[str, ...] = ()
        self._others_first: Callable[[], bool] = lambda: False
        self.runner: Task[SimulationRequest, Snapshot] = Task(self._simulate, "simulation")
        self.runner.reported.connect(self._show_early)
        self.runner.finished.connect(self._show)
        self.runner.failed.connect(self.failed)
        self.runner.failed_for.connect(self.failed_for)
        for store in (scenes, scenes.settings):
            store.changed.connect(self._submit)
        scenes.store.select(lambda workspace: workspace.decoder).changed.connect(self.read_with)
        self.ages = ResultAges(self._request())
        # Only the picture: the panes are not there yet, and it is not late at the start.
        self.runner.ask(self.ages.present)

    def draft_for(self, rows_per_pixel: Callable[[], float]) -> None:
        """Draft as many rows from now on as the screen shows, or fewer where drafts are late.

        ``rows_per_pixel``: returns how many rows of the picture fall on a pixel of the screen.
        """
        self._rows_per_pixel = rows_per_pixel

    def defer_while(self, others_first: Callable[[], bool]) -> None:
        """Delay exact pictures while ``others_first``, called on the worker's thread, is true."""
        self._others_first = others_first

    def read_with(self, decoder: str) -> None:
        """Read this scene and later ones with this decoder, too."""
        self._more = () if decoder in QUICK_DECODERS else (decoder,)
        read = self._read
        if self._more and (read is None or decoder not in read.results):
            self.runner.ask(self._request())

    def _request(self) -> SimulationRequest:
        scene = self._scenes.scene
        step = self._draft_rows.step(scene.camera.rows, self._rows_per_pixel())
        picture_kind = self._scenes.store.workspace.picture_kind
        settings = self._scenes.settings.settings
        return SimulationRequest(scene, settings, picture_kind, step, self._more)

    def _submit(self) -> None:
        request = self._request()
        if request == self.ages.present:  # one step has changed both stores
            return
        self.ages.begin(request)
        self.runner.ask(request)
        self.submitted.emit()

    def _simulate(self, request: SimulationRequest, report: TaskReporter) -> Snapshot:
        begun = perf_counter()
        planned = plan_scene(request.scene, request.settings)  # once for all that follows
        reading = reading_by_profile(request, planned)
        draft = draft_of(request, planned)
        # Without a draft something must be shown of every scene that is begun.
        heartbeat: Callable[[], None] = _go_on
        if draft is not None:
            reading = reading or reading_of_draft(request, draft)
            self._draft_rows.record_time(perf_counter() - begun)
            report(Picture.of(draft, request.picture_kind, request, reading))
            report.wait_for_paint(_LONGEST_PAINT)
            reading, heartbeat = None, report.give_way
            report.give_way(self.ages.rest(_REST_TIME))
            self._wait_for_others(report)
        elif reading is not None and not is_soon(planned):
            report(reading)
            reading = None
        frame = render_with(request.scene, request.settings, heartbeat=heartbeat, planned=planned)
        if reading is not None:
            reading = replace(reading, has_picture=True)
        report(Picture.of(frame, request.picture_kind, request, reading))
        report.wait_for_paint(_LONGEST_PAINT)
        if reading is not None:
            report.give_way()  # the scene's verdict is there: a later scene comes first
        snapshot = snapshot_of(request, frame)
        if unread_by(snapshot):
            report(snapshot)
        return explained(snapshot, report.give_way)

    def _wait_for_others(self, report: TaskReporter) -> None:
        """Leave both cores to short work for a while, unless a newer request comes."""
        for _ in range(_MOST_CHECKS):
            if not self._others_first():
                return
            report.give_way(CHECK_SECONDS)

    def _show_early(self, part: Picture | Reading) -> None:
        if isinstance(part, Snapshot):
            self._show(part)
            return
        reading = part.reading if isinstance(part, Picture) else part
        if reading is not None and self._is_news(reading):
            self._show_reading(reading)
        if isinstance(part, Picture):
            self.picture_ready.emit(part)

    def _show(self, snapshot: Snapshot) -> None:
        self.snapshot_ready.emit(snapshot)
        if self._is_news(snapshot):
            self._show_reading(snapshot)
        self.snapshot_shown.emit(snapshot)

    def _show_reading(self, reading: Reading) -> None:
        self._read = reading
        self.reading_shown.emit(reading)

    def _is_news(self, reading: Reading) -> bool:
        """Return whether a reading is of a later scene than the one shown, or more reliable."""
        shown = self._read
        if shown is None:
            return True
        if reading.request == shown.request:
            # During a movement the next scene's reading is sooner there than this would be drawn.
            is_present = reading.request == self.ages.present
            return is_present and SOURCES.index(reading.source) >= SOURCES.index(shown.source)
        return self.ages.age(reading.request) <= self.ages.age(shown.request)

    def stop(self) -> None:
        self.runner.stop()
        self.blockSignals(True)
