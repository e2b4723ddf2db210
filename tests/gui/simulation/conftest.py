"""Fixtures of a simulation controller."""

from collections.abc import Iterator
from threading import Event
from typing import Any

import pytest
from gui.simulation.bench import Bench
from pytestqt.qtbot import QtBot

from occ_gui.simulation import controller
from occ_model.scene.scene import Scene
from occ_model.simulation.render import render_with


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Iterator[Bench]:
    bench = Bench(small_scene, qtbot)
    bench.wait_until_idle()
    yield bench
    bench.controller.stop()


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch) -> Iterator[Event]:
    """Let no picture be simulated before this event is set."""
    may_end = Event()

    def wait_and_render(*arguments: Any, **named: Any) -> Any:
        may_end.wait()
        return render_with(*arguments, **named)

    monkeypatch.setattr(controller, "render_with", wait_and_render)
    yield may_end
    may_end.set()
