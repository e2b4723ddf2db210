"""The pane that the manual shows as an example is one, and shows what a picture's reading has."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from documents import FOLDER, blocks, text_of
from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.feature import Feature
from occ_gui.shell.results import Board, of_snapshot
from occ_gui.shell.shell import Shell
from occ_gui.simulation.snapshot import Snapshot


class Window(QMainWindow):
    """A window of one dock."""

    def __init__(self) -> None:
        super().__init__()
        self.actions_by_name: dict[str, Any] = {}

    def add_pane(self, name: str, title: str, content: QWidget) -> QDockWidget:
        self.dock = QDockWidget(title, self)
        self.dock.setWidget(content)
        return self.dock


@pytest.fixture
def example() -> Feature[Any]:
    *_, code = blocks(text_of(FOLDER / "developers.md"), "python")
    names: dict[str, Any] = {"__name__": "example"}
    exec(compile(code, "developers.md", "exec"), names)
    feature = names["run_lengths"]()
    assert isinstance(feature, Feature)
    return feature


def test_the_pane_of_the_manual_shows_the_stripes_of_each_picture(
    qtbot: QtBot, example: Feature[Any], snapshot_of: Callable[..., Snapshot]
) -> None:
    window, board, found = Window(), Board(), snapshot_of()
    qtbot.addWidget(window)
    shell = Shell(Store(Workspace(found.scene)), board)
    shell.add(example, window)
    window.show()
    window.dock.visibilityChanged.emit(True)
    pane = shell.pane("run_lengths")
    assert [curve.getData()[0] for curve in pane.curves] == [None, None]
    board.show_snapshot(found)
    assert found.decoded.histograms is not None
    for curve, histogram in zip(pane.curves, found.decoded.histograms, strict=True):
        assert np.array_equal(curve.getData()[1], histogram.counts)
    board.show_snapshot(snapshot_of(switching_frequency=500.0, exposure_time=1e-3))
    assert pane.made_of == {pane.plot: of_snapshot}
