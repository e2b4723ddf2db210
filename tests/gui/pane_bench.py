"""Panes without the application: values go in by hand, and what they want comes out as edits."""

from collections import defaultdict
from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from gui.kinds import simulate_once
from gui.stores import store_of
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QApplication,
    QDockWidget,
    QMainWindow,
    QMenu,
    QSlider,
    QStyle,
    QStyleOptionSlider,
    QWidget,
)
from pytestqt.qtbot import QtBot

from occ_gui.app.services import export
from occ_gui.background.task import Task
from occ_gui.detection_map.slider_strip import SliderStrips
from occ_gui.detection_map.wiring import BackgroundRates
from occ_gui.export.export_controller import ExportController
from occ_gui.files.preferences import Preferences
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.parameter_rows import QuantityRow
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.shell.feature import Feature
from occ_gui.shell.results import ResultsStore
from occ_gui.shell.shell import Shell
from occ_gui.simulation.moves import MoveLog
from occ_gui.simulation.present_results import ResultsConsumer
from occ_gui.simulation.snapshot import Picture, Snapshot
from occ_gui.values.modes import Places, Side
from occ_gui.window.docks import CurrentPane
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene


def handle_middle(slider: QSlider) -> float:
    """Return where the middle of a slider's handle is, in its parent."""
    option = QStyleOptionSlider()
    slider.initStyleOption(option)
    control, part = QStyle.ComplexControl.CC_Slider, QStyle.SubControl.SC_SliderHandle
    handle = slider.style().subControlRect(control, option, part, slider)
    return float(slider.x() + handle.x() + handle.width() / 2)


class PlainWindow(QMainWindow):
    """A window with docks, and with every menu entry that is asked for."""

    def __init__(self) -> None:
        super().__init__()
        self.actions_by_name: dict[str, QAction] = defaultdict(lambda: QAction(self))
        self.docks: dict[str, QDockWidget] = {}

    def add_pane(
        self, name: str, title: str, content: QWidget, _places: Places, _default_side: Side
    ) -> QDockWidget:
        dock = self.docks[name] = QDockWidget(title, self)
        dock.setWidget(content)
        self.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, dock)
        dock.hide()
        return dock


class Present:
    """Gives the results in a store as those of the present scene."""

    def __init__(self, results_store: ResultsStore) -> None:
        self._results_store = results_store

    @property
    def latest(self) -> Snapshot | None:
        return self._results_store.results.snapshot

    def ask(self, use: ResultsConsumer) -> None:
        assert self.latest is not None
        use(self.latest)


class PaneBench:
    """Stores and a shell for the features that a test adds; simulates on request only."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        self.scenes, self.results_store, self.window = (
            store_of(scene),
            ResultsStore(),
            PlainWindow(),
        )
        self.store, self.settings = self.scenes.store, self.scenes.settings
        self.simulation: Any = SimpleNamespace(
            task=Task(lambda *_: None, "no simulation"), moves=MoveLog()
        )
        self.called_first: list[Callable[[Snapshot], object]] = []
        """Functions that are called with exact results before the panes."""
        self.shell, self.said = Shell(self.store, self.results_store), list[str]()
        for said in (self.shell.status_message, self.shell.file_failed):
            said.connect(self.said.append)
        self.settings.refused.connect(self.said.append)
        qtbot.addWidget(self.window, before_close_func=lambda _window: self.stop())
        self._qtbot, self._before = qtbot, QApplication.topLevelWidgets()

    def add(self, feature: Feature[Any], *, seen: bool = True) -> Any:
        """Add a pane or a service, and return it."""
        self.shell.add(feature, self.window)
        if feature.title and seen:
            self.see(feature.name)
        return self.shell.pane(feature.name)

    def see(self, name: str, seen: bool = True) -> None:
        self.window.show()
        self.window.docks[name].setVisible(seen)
        self.window.docks[name].visibilityChanged.emit(seen)

    def simulate(self, **changes: Any) -> Snapshot:
        """Change the scene, and put its exact results into the store."""
        if changes:
            self.scenes.change(**changes)
        workspace = self.store.workspace
        snapshot = simulate_once(workspace.scene, workspace.settings)
        for function in self.called_first:
            function(snapshot)
        self.results_store.show_picture(Picture(snapshot.frame, snapshot.request))
        self.results_store.show_reading(snapshot)
        self.results_store.show_snapshot(snapshot)
        return snapshot

    @cached_property
    def background_rates(self) -> BackgroundRates:
        """The channels of the processes; nothing is measured along a slider."""
        row = QuantityRow(quantity("iso"))
        row.setParent(self.window)
        strips = SliderStrips({"iso": row})
        strips.legend.setParent(self.window)  # a kept window sees whatever outlives its test
        return BackgroundRates(self.scenes, strips, lambda: False)

    @cached_property
    def exporter(self) -> ExportController:
        """What exports the figures of the panes."""
        present: Any = Present(self.results_store)
        current = CurrentPane(self.window, self.window.docks)
        feature = export(
            self.window, self.shell, present, Preferences(None), lambda: current.name, self.store
        )
        exporter: ExportController = self.add(feature)
        return exporter

    def export(self, name: str, path: Path) -> str:
        self.exporter.export(name, path)
        self.wait_until_idle()
        return self.said[-1]

    def wait_until_idle(self) -> None:
        self._qtbot.waitUntil(lambda: self.shell.is_idle)

    def stop(self) -> None:
        self.shell.stop()
        # What the application puts into its window would outlive the test.
        for widget in QApplication.topLevelWidgets():
            if widget not in self._before and not isinstance(widget, QMenu):
                widget.setParent(self.window)


class ControlsBench(PaneBench):
    """The controls of the scene, which edit it and follow it."""

    def __init__(self, qtbot: QtBot, scene: Scene) -> None:
        super().__init__(qtbot, scene)
        self.controls, self.editor = ControlPanel(), SceneEditor(self.scenes)
        self.controls.connect_editor(self.editor)
        self.controls.show_scene(scene)
        self.scenes.changed.connect(self.controls.show_scene)
        self.window.setCentralWidget(self.controls)
        self.window.resize(1280, 800)
        self.window.show()

    def row(self, name: str) -> QuantityRow:
        return self.controls.main_rows()[name]

    def enter(self, name: str, text: str) -> None:
        field = self.row(name).field
        field.selectAll()
        self._qtbot.keyClicks(field, text)
        self._qtbot.keyClick(field, Qt.Key.Key_Return)

    def stop(self) -> None:
        super().stop()
        self.controls.player.stop()
