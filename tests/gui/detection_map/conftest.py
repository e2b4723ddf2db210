"""The pane of the map without the window around it."""

from collections.abc import Iterator

import pytest
from gui.detection_map.map_bench import MapBench
from pytestqt.qtbot import QtBot

from occ_model.scene.scene import Scene


@pytest.fixture
def map_bench(
    qtbot: QtBot, small_scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> Iterator[MapBench]:
    """Give the pane of the map."""
    bench = MapBench(qtbot, small_scene, monkeypatch)
    yield bench
    bench.stop()
