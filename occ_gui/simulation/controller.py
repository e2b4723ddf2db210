"""Simulate the store's scene whenever it or the settings change, and hand the results over."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from time import perf_counter, sleep
from typing import Protocol

from PySide6.QtCore import QObject, Signal

import occ_model as occ
from occ_gui.background.latest_wins import LatestWins
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.settings_store import FIRST_SETTINGS, SettingsStore
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.request import SimulationRequest
from occ_gui.simulation.snapshot import Snapshot
from occ_model.receiver.decoders import DECODERS
from occ_model.results import DecodeResult, Frame
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings
from occ_model.transmitter.packet import bits_of

_TURN = 0.004
"""Seconds that the window has to paint a picture in before it is read."""


class SnapshotView(Protocol):
    """A pane that shows the results for a scene."""

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""


class PictureView(Protocol):
    """A pane that shows a picture before it has been read."""

    def show_picture(self, picture: Picture) -> None:
        """Show this picture in place of the last one."""


def simulate(
    scene: Scene,
    settings: SimulationSettings = FIRST_SETTINGS,
    hand_over: Callable[[Frame], object] = lambda _frame: None,
) -> Snapshot:
    """Make everything that the views show of a scene.

    Parameters
    ----------
    scene
        The scene.
    settings
        How it is simulated.
    hand_over
        Is given the picture before it is read, which takes longer than to simulate it.

    Raises
    ------
    ParameterError
        A setting cannot be.
    ProjectionError
        The panel has no picture in this pose.
    """
    frame = occ.render(scene, **settings.arguments())
    hand_over(frame)
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
    """Connects the stores, the simulation's thread and the views.

    Parameters
    ----------
    scenes
        Its scene is simulated, at once and after every change.
    settings
        How it is simulated.
    """

    shown = Signal(object)
    """The snapshot that the views have just been given."""

    failed = Signal(str)
    """Why the scene has no picture; the views keep the last one."""

    def __init__(self, scenes: SceneStore, settings: SettingsStore) -> None:
        super().__init__()
        self._scenes = scenes
        self._settings = settings
        self._views: Sequence[SnapshotView] = ()
        self._pictures: Sequence[PictureView] = ()
        self.runner: LatestWins[SimulationRequest, Snapshot] = LatestWins(
            self._simulate, "simulation"
        )
        self.runner.early.connect(self._show_picture)
        self.runner.finished.connect(self._show)
        self.runner.failed.connect(self.failed)
        for store in (scenes, settings):
            store.changed.connect(self._submit)
        self._submit()

    def show_in(self, views: Sequence[SnapshotView], pictures: Sequence[PictureView] = ()) -> None:
        """Show in these panes what comes from now on: nothing does before the event loop runs.

        Parameters
        ----------
        views
            The panes that show the results.
        pictures
            Those that show the picture while it is still being read.
        """
        self._views, self._pictures = views, pictures

    def _submit(self) -> None:
        self.runner.submit(SimulationRequest(self._scenes.scene, self._settings.settings))

    def _simulate(self, request: SimulationRequest) -> Snapshot:
        return simulate(request.scene, request.settings, self._hand_over)

    def _hand_over(self, frame: Frame) -> None:
        self.runner.hand_over(Picture.of(frame))
        # The window paints it meanwhile. Reading at once would make it wait: for the interpreter,
        # and for the memory that both read the picture from.
        sleep(_TURN)

    def _show_picture(self, picture: Picture) -> None:
        for view in self._pictures:
            view.show_picture(picture)

    def _show(self, snapshot: Snapshot) -> None:
        for view in self._views:
            view.show_snapshot(snapshot)
        self.shown.emit(snapshot)

    def stop(self) -> None:
        """Stop simulating."""
        self.runner.stop()
