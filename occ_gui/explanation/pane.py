"""The pane of the equations: it explains the scene, and the exposure of a column."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from occ_gui.explanation.column_picker import ColumnPicker
from occ_gui.explanation.equation_controller import EquationController
from occ_gui.explanation.equation_text import EquationText
from occ_gui.explanation.exposure_controller import ExposureController
from occ_gui.explanation.exposure_plot import ExposurePlot
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import of_snapshot
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.plot import Plot


class ExplanationView(QWidget):
    """The equations with their current numbers, above the exposure of a column."""

    def __init__(self) -> None:
        super().__init__()
        self.equations, self.exposure = EquationText(), ExposurePlot()
        panes = QSplitter(Qt.Orientation.Vertical)
        panes.addWidget(self.equations)
        panes.addWidget(self.exposure)
        panes.setChildrenCollapsible(False)
        panes.setStretchFactor(0, 3)
        panes.setStretchFactor(1, 2)
        filled(QVBoxLayout(self), panes, margins=0)


class ExplanationPane(Pane[Snapshot]):
    """Connects the equations of the scene, and the exposure of the column under the mouse."""

    def __init__(self, scenes: SceneStore, plot: Plot) -> None:
        pane = ExplanationView()
        super().__init__(pane)
        self.pane = pane
        self.made_of = {
            pane.exposure: of_snapshot
        }  # it tells a level; the equations need no picture
        self.picker = ColumnPicker(plot)
        self._equations = EquationController(scenes, self.pane.equations)
        exposure = self.exposure = ExposureController(self.pane.exposure, self.picker)
        self.picker.hovered.connect(exposure.hover)
        self.picker.clicked.connect(exposure.click)
        self.picker.stepped.connect(exposure.step)
        self.picker.released.connect(lambda: exposure.hold(False))
        self.pane.exposure.column_chosen.connect(exposure.choose)
        self.pane.exposure.hold_chosen.connect(exposure.hold)

    def set_seen(self, seen: bool) -> None:
        self._equations.set_seen(seen)
        self.exposure.set_seen(seen)

    def show_part(self, part: Snapshot) -> None:
        self.exposure.show_snapshot(part)
