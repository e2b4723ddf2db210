"""Fixtures of a simulation controller."""

from collections.abc import Iterator

import pytest
from gui.simulation.bench import Bench
from pytestqt.qtbot import QtBot

from occ_model.scene.scene import Scene


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Iterator[Bench]:
    bench = Bench(small_scene, qtbot)
    bench.wait_until_idle()
    yield bench
    bench.controller.stop()
