"""The pane of the map without the window, with workers that a test chooses."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from gui.conftest import LazyWorkers
from gui.pane_bench import PaneBench
from pytestqt.qtbot import QtBot

from occ_gui.app.panes import detection_map
from occ_gui.detection_map import wiring
from occ_gui.detection_map.map_view import MapView
from occ_gui.detection_map.pane import MapPane
from occ_model.scene.scene import Scene


class MapBench(PaneBench):
    """Map, limits and advice in a pane that is hidden until a test shows it."""

    def __init__(self, qtbot: QtBot, scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
        super().__init__(qtbot, scene)
        self.workers: Any = LazyWorkers()
        monkeypatch.setattr(wiring, "new_workers", lambda: self.workers)
        feature = detection_map(self.scenes, self.background_rates)
        self.shell.add(feature, self.window)

    @property
    def pane(self) -> MapPane:
        pane: MapPane = self.shell.pane("map")
        return pane

    @property
    def view(self) -> MapView:
        return self.pane.view

    def choose_decoder(self, name: str) -> None:
        self.store.put(replace(self.store.workspace, decoder=name))

    def stop(self) -> None:
        self.shell.stop()
        self.background_rates.stop()


@pytest.fixture
def map_bench(
    qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> Iterator[MapBench]:
    bench = MapBench(qtbot, small_scene, monkeypatch)
    yield bench
    bench.stop()
