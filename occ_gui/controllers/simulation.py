"""Simulate the store's scene whenever it changes, and hand the results to the views."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from time import perf_counter
from typing import Protocol

from PySide6.QtCore import QObject, Signal

import occ_model as occ
from occ_gui.state.scene_store import SceneStore
from occ_gui.state.snapshot import Snapshot
from occ_gui.tasks.latest_wins import LatestWins
from occ_model.receiver.decoders import DECODERS
from occ_model.results import DecodeResult
from occ_model.scene import Scene
from occ_model.transmitter.packet import bits_of


class SnapshotView(Protocol):
    """A pane that shows the results for a scene."""

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""


def simulate(scene: Scene) -> Snapshot:
    """Make everything that the views show of a scene.

    Raises
    ------
    ProjectionError
        The panel has no picture in this pose.
    """
    frame = occ.render(scene)
    start = perf_counter()
    decoded = occ.decode(frame.image, scene)
    reading_seconds = perf_counter() - start
    others = tuple(_read_alike(decoded, scene))
    band, undefined = None, ""
    try:
        band = occ.band_profile(scene)
    except occ.BandModelUndefined as reason:
        undefined = str(reason)
    transmitter = scene.transmitter
    sent = () if transmitter.pattern else bits_of(transmitter.code, transmitter.bits)
    chip_columns = transmitter.switching_period / scene.camera.readout_time
    left, top = frame.corners.min(axis=0).tolist()
    return Snapshot(
        frame=frame,
        decoded=decoded,
        sent=sent,
        packet_columns=chip_columns * len(occ.packet(scene)),
        panel_origin=(max(left, 0.0), max(top, 0.0)),
        band=band,
        band_undefined=undefined,
        reading_seconds=reading_seconds,
        others=others,
    )


def _read_alike(decoded: DecodeResult, scene: Scene) -> Iterator[DecodeResult]:
    """Let the other decoders read the signal that one has taken from the picture."""
    for name, decoder in DECODERS.items():
        if name == decoded.decoder:
            continue
        if decoded.signal is None:  # no panel found: the same for all
            yield DecodeResult(name, failure=decoded.failure)
        else:
            result = decoder.read(decoded.signal, scene)
            yield replace(result, region=decoded.region, location=decoded.location)


class SimulationController(QObject):
    """Connects the store, the simulation's thread and the views.

    Parameters
    ----------
    store
        Its scene is simulated, at once and after every change.
    views
        The panes that show the results.
    """

    shown = Signal(object)
    """The snapshot that the views have just been given."""

    failed = Signal(str)
    """Why the scene has no picture; the views keep the last one."""

    def __init__(self, store: SceneStore, views: Sequence[SnapshotView]) -> None:
        super().__init__()
        self._views = views
        self.runner: LatestWins[Scene, Snapshot] = LatestWins(simulate, "simulation")
        self.runner.finished.connect(self._show)
        self.runner.failed.connect(self.failed)
        store.changed.connect(self.runner.submit)
        self.runner.submit(store.scene)

    def _show(self, snapshot: Snapshot) -> None:
        for view in self._views:
            view.show_snapshot(snapshot)
        self.shown.emit(snapshot)

    def stop(self) -> None:
        """Stop simulating."""
        self.runner.stop()
