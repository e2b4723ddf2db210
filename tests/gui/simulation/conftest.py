"""Fixtures of a simulation controller."""

from collections.abc import Iterator
from typing import Any

import pytest
from gui.stores import store_of
from pytestqt.qtbot import QtBot

from occ_gui.simulation.controller import SimulationController
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_model.scene.scene import Scene


class RecordingView:
    """A view that records all that it receives."""

    def __init__(self) -> None:
        self.snapshots: list[Snapshot] = []
        self.readings: list[Reading] = []

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self.snapshots.append(snapshot)

    def show_reading(self, reading: Reading) -> None:
        self.readings.append(reading)


class SimulationBench:
    """A store and a controller on two mock views."""

    def __init__(self, scene: Scene, qtbot: QtBot) -> None:
        self.store = store_of(scene)
        self.settings = self.store.settings
        self.views = (RecordingView(), RecordingView())
        self.controller = SimulationController(self.store)
        for view in self.views:
            self.controller.snapshot_ready.connect(view.show_snapshot)
            self.controller.reading_shown.connect(view.show_reading)
        self.failures: list[str] = []
        self.controller.failed.connect(self.failures.append)
        self._qtbot = qtbot

    def wait_until_idle(self) -> None:
        self._qtbot.waitUntil(lambda: self.controller.task.is_idle)

    def change(self, **parameters: Any) -> None:
        self.store.change(**parameters)
        self.wait_until_idle()

    @property
    def scenes(self) -> list[Scene]:
        return [snapshot.frame.scene for snapshot in self.views[0].snapshots]


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Iterator[SimulationBench]:
    bench = SimulationBench(small_scene, qtbot)
    bench.wait_until_idle()
    yield bench
    bench.controller.stop()
