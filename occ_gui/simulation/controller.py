"""Simulation controller: simulates and decodes the scene in the background after every change."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from time import perf_counter, sleep
from typing import Protocol

from PySide6.QtCore import QObject, Qt, Signal

import occ_model as occ
from occ_gui.background.latest_wins import LatestWins
from occ_gui.background.result_age import ResultAges
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import FIRST_SETTINGS, SettingsStore
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import SimulationRequest, Snapshot
from occ_model.effects.plan import called_for_by_signal
from occ_model.receiver.decoders import DECODERS
from occ_model.results import DecodeResult, Frame
from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.simulation.band_model import enhanced_band_profile
from occ_model.simulation.render import render_with

_PAINT_TIME = 0.004
"""Seconds between the delivery of a picture and its decoding, for the window to paint it."""


class SnapshotView(Protocol):
    """A pane that shows the results for a scene."""

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""


def simulate(scene: Scene, settings: SimulationSettings = FIRST_SETTINGS) -> Snapshot:
    """Simulate a scene and decode its picture.

    Parameters
    ----------
    scene
        The scene.
    settings
        The settings of its simulation.

    Raises
    ------
    ParameterError
        A setting is invalid.
    ProjectionError
        The panel has no picture in this pose.
    """
    return _snapshot_of(SimulationRequest(scene, settings), render_with(scene, settings))


def _snapshot_of(request: SimulationRequest, frame: Frame) -> Snapshot:
    """Decode a picture and compute the other results that the panes show."""
    scene = frame.scene
    start = perf_counter()
    decoded = occ.decode(frame.image, scene)
    reading_seconds = perf_counter() - start
    others = tuple(_decode_with_others(decoded, scene))
    band, enhanced_band, undefined = None, None, ""
    try:
        band = occ.band_profile(scene)
        enhanced_band = enhanced_band_profile(scene, band)
    except occ.BandModelUndefined as reason:
        undefined = str(reason)
    transmitter = scene.transmitter
    sent = () if transmitter.pattern else transmitter.payload_bits
    chip_columns = transmitter.switching_period / scene.camera.readout_time
    left, top = frame.corners.min(axis=0).tolist()
    return Snapshot(
        request=request,
        frame=frame,
        decoded=decoded,
        sent=sent,
        packet_columns=chip_columns * len(occ.packet(scene)),
        panel_origin=(max(left, 0.0), max(top, 0.0)),
        band=band,
        enhanced_band=enhanced_band,
        band_undefined=undefined,
        reading_seconds=reading_seconds,
        others=others,
        called_for=called_for_by_signal(frame.plan, scene),
    )


def _decode_with_others(decoded: DecodeResult, scene: Scene) -> Iterator[DecodeResult]:
    """Decode the signal that one decoder has located in the picture with the other decoders."""
    for name, decoder in DECODERS.items():
        if name == decoded.decoder:
            continue
        if decoded.signal is None:  # no panel found, which holds for all decoders
            yield DecodeResult(name, failure=decoded.failure)
        else:
            result = decoder.read(decoded.signal, scene)
            yield replace(result, region=decoded.region, location=decoded.location)


class SimulationController(QObject):
    """Connects the stores, the thread of the simulation and the panes.

    Parameters
    ----------
    scenes
        The store of the scene, which is simulated at once and after every change.
    settings
        The store of the settings of the simulation.
    """

    picture_ready = Signal(object)
    """The Picture of a scene, before it is decoded; emitted once the event loop runs."""

    snapshot_shown = Signal(object)
    """The Snapshot that the panes show from now on."""

    failed = Signal(str)
    """The reason why a scene has no picture; the panes keep the last one."""

    failed_for = Signal(str, object)
    """The same, and the names of the parameters that it is about."""

    submitted = Signal()
    """The scene or a setting has changed: results of the last request are outdated."""

    _rendered = Signal(object)

    def __init__(self, scenes: SceneStore, settings: SettingsStore) -> None:
        super().__init__()
        self._scenes = scenes
        self._settings = settings
        self._views: Sequence[SnapshotView] = ()
        self._whose = PICTURES[0]
        # Emitted on the simulation's thread, received on the window's.
        self._rendered.connect(self.picture_ready, Qt.ConnectionType.QueuedConnection)
        self.runner: LatestWins[SimulationRequest, Snapshot] = LatestWins(
            self._simulate, "simulation"
        )
        self.runner.finished.connect(self._show)
        self.runner.failed.connect(self.failed)
        self.runner.failed_for.connect(self.failed_for)
        for store in (scenes, settings):
            store.changed.connect(self._submit)
        self.ages = ResultAges(self._request())
        self.runner.submit(self.ages.present)

    def show_in(self, views: Sequence[SnapshotView]) -> None:
        """Set the panes that show the results; none arrives before the event loop runs."""
        self._views = views

    def prepare_picture(self, whose: str) -> None:
        """Prepare the picture of the camera or of the receiver for drawing from now on."""
        self._whose = whose

    def _request(self) -> SimulationRequest:
        return SimulationRequest(self._scenes.scene, self._settings.settings, self._whose)

    def _submit(self) -> None:
        request = self._request()
        if request == self.ages.present:  # one step has changed both stores
            return
        self.ages.begin(request)
        self.runner.submit(request)
        self.submitted.emit()

    def _simulate(self, request: SimulationRequest) -> Snapshot:
        frame = render_with(request.scene, request.settings)
        self._rendered.emit(Picture.of(frame, request.whose, request))
        # Decoding at once would delay the painting, which needs the same interpreter and memory.
        sleep(_PAINT_TIME)
        return _snapshot_of(request, frame)

    def _show(self, snapshot: Snapshot) -> None:
        for view in self._views:
            view.show_snapshot(snapshot)
        self.snapshot_shown.emit(snapshot)

    def stop(self) -> None:
        """Stop simulating; no picture or snapshot arrives from now on."""
        self.runner.stop()
        self.blockSignals(True)
