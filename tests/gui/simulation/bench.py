"""A store and a simulation controller on mock views."""

from gui.stores import store_of
from pytestqt.qtbot import QtBot

from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_model.scene.scene import Scene


class RecordingView:
    """A view that keeps all that it is shown."""

    def __init__(self) -> None:
        self.shown: list[Snapshot] = []
        self.read: list[Reading] = []

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self.shown.append(snapshot)

    def show_reading(self, reading: Reading) -> None:
        self.read.append(reading)


class Bench:
    """A store and a controller on two mock views."""

    def __init__(self, scene: Scene, qtbot: QtBot) -> None:
        self.store = store_of(scene)
        self.settings = self.store.settings
        self.views = (RecordingView(), RecordingView())
        self.controller = SimulationController(self.store)
        self.controller.show_in(self.views, self.views)
        self.failures: list[str] = []
        self.controller.failed.connect(self.failures.append)
        self._qtbot = qtbot

    def wait_until_idle(self) -> None:
        self._qtbot.waitUntil(lambda: self.controller.runner.is_idle)

    @property
    def scenes(self) -> list[Scene]:
        return [snapshot.frame.scene for snapshot in self.views[0].shown]
