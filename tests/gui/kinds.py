"""Types of common fixtures, and functions for widgets, results and signals in tests."""

import pickle
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.simulation.controller import simulate
from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.decoding import DecodeResult
from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene, SimulationSettings

Grey: TypeAlias = NDArray[np.uint8]
GreyPicture: TypeAlias = Callable[[QWidget], Grey]
SnapshotOf: TypeAlias = Callable[..., Snapshot]

Widget = TypeVar("Widget", bound=QWidget)


def with_result(snapshot: Snapshot, result: DecodeResult) -> Snapshot:
    """Replace the result of a decoder."""
    return replace(snapshot, results={**snapshot.results, result.decoder: result})


def add_widget(qtbot: QtBot, widget: Widget) -> Widget:
    """Let a widget be closed at the end of the test."""
    qtbot.addWidget(widget)
    return widget


def show_widget(qtbot: QtBot, widget: Widget, width: int = 0, height: int = 0) -> Widget:
    """Show a widget, in its own size or in this one."""
    add_widget(qtbot, widget)
    if width:
        widget.resize(width, height)
    widget.show()
    return widget


@lru_cache(maxsize=4)  # pictures take much memory
def _simulate_pickled(asked: bytes) -> Snapshot:
    snapshot = simulate(*pickle.loads(asked))
    for picture_kind in PICTURES:  # others show them, too
        snapshot.frame.picture(picture_kind).flags.writeable = False
    return snapshot


def simulate_once(scene: Scene, settings: SimulationSettings = FIRST_SETTINGS) -> Snapshot:
    """Simulate a scene as the window does, once for the tests that want the same."""
    return _simulate_pickled(pickle.dumps((scene, settings)))


def collect(signal: Any) -> list[Any]:
    """Return a list to which all values of a signal will be appended."""
    values: list[Any] = []
    signal.connect(values.append)
    return values
