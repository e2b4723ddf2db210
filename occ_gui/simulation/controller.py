"""Simulation controller: simulates and decodes the scene in the background after every change.

The results of a change arrive in this order, each by a signal:

1. ``submitted``: the results shown are those of an earlier scene from now on.
2. ``picture_ready`` with a Picture of some rows, a draft, if the whole one takes long; and with it,
   so that both are painted together, ``reading_shown`` with a Reading: the profile, the band model
   and the verdict of every decoder. It is read from column means, without pixels, or from the
   draft if the rows of the scene differ (a lens, a file, a panel that is not level). While the
   scene keeps changing, this begins again at 1.
3. ``picture_ready`` with the exact rows that show the panel, if the others take much longer, and
   with the exact Picture, before it is decoded. Without a draft, the Reading comes with it, or
   before it if the picture is small but takes time.
4. ``snapshot_ready``, ``reading_shown`` and ``snapshot_shown`` with the Snapshot, which was read
   from that picture. It is a Reading, too, and the final one. If a decoder has failed, these come
   again when the cause is known.

A reading is never replaced by one of an earlier scene. ``failed`` says why a scene has no picture.
"""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from occ_gui.background.result_age import ResultAges
from occ_gui.background.task import Task, TaskReporter
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.scene.scene_store import SceneStore
from occ_gui.simulation.jobs import (
    DraftRows,
    begin_move,
    explain_failures,
    is_fast,
    snapshot_of,
)
from occ_gui.simulation.moves import MoveLog, MoveTime
from occ_gui.simulation.snapshot import SOURCES, Picture, Reading, Snapshot
from occ_gui.simulation.verdict import failed_decoders
from occ_gui.values.simulated import LEAST_DRAFT_STEP, SimulationRequest
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.results.frame import Frame
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.render import render_with

_REST_TIME = 0.05  # seconds without a change after which the exact picture is begun

_LONGEST_PAINT = 0.1  # longest time in seconds that work waits until the window has painted

CHECK_SECONDS, _MOST_CHECKS = 0.005, 20
"""Seconds between two checks whether the exact picture may begin, and the most checks."""


def simulate(scene: Scene, settings: SimulationSettings = FIRST_SETTINGS) -> Snapshot:
    """Simulate a scene and decode its picture; raises ParameterError or ProjectionError."""
    request = SimulationRequest(scene, settings)
    return explain_failures(snapshot_of(request, render_with(scene, settings)))


class SimulationController(QObject):
    """Connects stores, thread and panes; simulates the scene after every change."""

    picture_ready = Signal(object)
    """The Picture of a scene, before it is decoded; its Reading, if any, is shown already."""

    reading_shown = Signal(object)
    """The Reading that the panes show from now on; a Snapshot if it was read from the picture."""

    snapshot_ready = Signal(object)  # the Snapshot of a picture that has been decoded
    snapshot_shown = Signal(object)  # the same, once the panes show it
    failed = Signal(str)  # the reason why a scene has no picture; the panes keep the last one
    failed_for = Signal(str, object)  # the same, and the names of the parameters concerned

    submitted = Signal()  # the scene or a setting has changed: the last results are outdated

    def __init__(self, scenes: SceneStore) -> None:
        super().__init__()
        self._scenes = scenes
        self._reading: Reading | None = None
        self._rows_per_pixel: Callable[[], float] = lambda: float(LEAST_DRAFT_STEP)
        self._draft_rows = DraftRows()
        self.moves = MoveLog()
        self._extra_decoders: tuple[str, ...] = ()
        self._must_wait: Callable[[], bool] = lambda: False
        self.task: Task[SimulationRequest, Snapshot] = Task(self._simulate, "simulation")
        self.task.reported.connect(self._show_report)
        self.task.finished.connect(self._show)
        self.task.failed.connect(self.failed)
        self.task.failed_for.connect(self.failed_for)
        for store in (scenes, scenes.settings):
            store.changed.connect(self._submit)
        scenes.store.select(lambda workspace: workspace.decoder).changed.connect(self.add_decoder)
        self.ages = ResultAges(self._request())
        # No signal is needed, because there are no panes yet.
        self.task.ask(self.ages.present)

    def set_draft_resolution(self, rows_per_pixel: Callable[[], float]) -> None:
        """Give drafts as many rows as the screen shows, or fewer if drafts are late.

        ``rows_per_pixel``: returns how many rows of the picture fall on a pixel of the screen.
        """
        self._rows_per_pixel = rows_per_pixel

    def defer_while(self, must_wait: Callable[[], bool]) -> None:
        """Delay exact pictures while ``must_wait``, called on the worker's thread, returns True."""
        self._must_wait = must_wait

    def add_decoder(self, decoder: str) -> None:
        """Read this and later scenes with this decoder, too."""
        self._extra_decoders = () if decoder in QUICK_DECODERS else (decoder,)
        reading = self._reading
        if self._extra_decoders and (reading is None or decoder not in reading.results):
            self.task.ask(self._request())

    def _request(self) -> SimulationRequest:
        scene = self._scenes.seen
        step = self._draft_rows.choose_step(scene.camera.rows, self._rows_per_pixel())
        picture_kind = self._scenes.store.workspace.picture_kind
        settings = self._scenes.settings.settings
        return SimulationRequest(scene, settings, picture_kind, step, self._extra_decoders)

    def _submit(self) -> None:
        request = self._request()
        if request == self.ages.present:  # one step has changed both stores
            return
        self.ages.begin(request)
        self.task.ask(request)
        self.submitted.emit()

    def _simulate(self, request: SimulationRequest, report: TaskReporter) -> Snapshot:
        move = begin_move(request)
        planned, reading, draft = move.planned, move.reading, move.draft
        # Without a draft, a scene whose simulation has begun is always shown.
        heartbeat: Callable[[], None] = report.give_way if draft is not None else lambda: None

        def show(frame: Frame, reading: Reading | None = None) -> None:
            frame.picture(request.picture_kind)  # made here, since the window must not wait for it
            report(Picture(frame, request, reading))
            report.wait_for_paint(_LONGEST_PAINT)

        if draft is not None:
            self._draft_rows.record_time(move.draft_seconds)
            report(MoveTime.of(draft, move.draft_seconds))
            show(draft, reading)
            reading = None
            report.give_way(self.ages.rest(_REST_TIME))
            self._wait_for_others(report)
        elif reading is not None and not is_fast(planned):
            report(reading)
            reading = None
        frame = render_with(
            request.scene, request.settings, heartbeat=heartbeat, planned=planned,
            show_panel=None if draft is None else show,
        )  # fmt: skip
        if reading is not None:
            reading = replace(reading, has_picture=True)
        show(frame, reading)
        if reading is not None:
            report.give_way()  # the verdict is shown already, so a later scene comes first
        snapshot = snapshot_of(request, frame)  # which may need the receiver's picture, too
        report(MoveTime.of(frame))
        if failed_decoders(snapshot):
            report(snapshot)
        return explain_failures(snapshot, report.give_way)

    def _wait_for_others(self, report: TaskReporter) -> None:
        """Leave both cores to short work for a while, unless a newer request comes."""
        for _ in range(_MOST_CHECKS):
            if not self._must_wait():
                return
            report.give_way(CHECK_SECONDS)

    def _show_report(self, result: Picture | Reading | MoveTime) -> None:
        if isinstance(result, MoveTime):
            self.moves.add(result)
            return
        if isinstance(result, Snapshot):
            self._show(result)
            return
        reading = result.reading if isinstance(result, Picture) else result
        if reading is not None and self._is_newer(reading):
            self._show_reading(reading)
        if isinstance(result, Picture):
            self.picture_ready.emit(result)

    def _show(self, snapshot: Snapshot) -> None:
        self.snapshot_ready.emit(snapshot)
        if self._is_newer(snapshot):
            self._show_reading(snapshot)
        self.snapshot_shown.emit(snapshot)

    def _show_reading(self, reading: Reading) -> None:
        self._reading = reading
        self.reading_shown.emit(reading)

    def _is_newer(self, reading: Reading) -> bool:
        """Return whether a reading is of a later scene than the one shown, or more reliable."""
        last = self._reading
        if last is None:
            return True
        if reading.request == last.request:
            # While a slider moves, the reading of the next scene arrives before this one is drawn.
            is_present = reading.request == self.ages.present
            return is_present and SOURCES.index(reading.source) >= SOURCES.index(last.source)
        return self.ages.age(reading.request) <= self.ages.age(last.request)

    def stop(self) -> None:
        self.task.stop()
        self.blockSignals(True)
