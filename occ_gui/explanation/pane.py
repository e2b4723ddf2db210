"""The pane of the equations, which explains the scene and the exposure of a column."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from occ_gui.explanation.equation_controller import EquationController
from occ_gui.explanation.equation_text import EquationText
from occ_gui.explanation.exposure_plot import ColumnPicker, ExposurePlot
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import of_snapshot
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.widgets.building import fill
from occ_gui.widgets.plot import Plot
from occ_model.teaching.light_over_columns import exposure_window


class ExposureController(QObject):
    """Keeps the chosen column, held or under the mouse, and computes its exposure while visible."""

    column_held = Signal(int)  # the column that the user has chosen and that stays chosen

    def __init__(self, plot: ExposurePlot, picker: ColumnPicker) -> None:
        super().__init__()
        self._plot, self._picker = plot, picker
        self._snapshot: Snapshot | None = None
        self._column: int | None = None
        self._is_held = False
        self._is_visible = False

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        self._picker.set_active(visible)
        self._show()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._show()

    def hover(self, column: int) -> None:
        """Show the column under the mouse, unless a column is held."""
        if not self._is_held:
            self._choose(column, is_held=False)

    def click(self, column: int) -> None:
        if self._is_held and column == self._column:
            self._choose(column, is_held=False)
        else:
            self.choose(column)

    def step(self, columns: int) -> None:
        if self._column is not None:
            self.choose(self._column + columns)

    def choose(self, column: int) -> None:
        self._choose(column, is_held=True)
        self.column_held.emit(self._column)

    def follow(self, column: int) -> None:
        if column != self._column:
            self._choose(column, is_held=self._is_held)

    def hold(self, is_held: bool) -> None:
        """Hold the column that is shown, or let the mouse choose the column."""
        self._is_held = is_held
        self._show()

    def _choose(self, column: int, is_held: bool) -> None:
        self._column, self._is_held = column, is_held
        self._show()

    def _show(self) -> None:
        snapshot = self._snapshot
        if snapshot is None or not self._is_visible:
            return
        profile = snapshot.frame.profile
        if self._column is None:  # start in the first packet, which the profile shows
            self._column = int(snapshot.panel_origin[0] + snapshot.period_columns / 2)
        self._column = min(max(self._column, 0), len(profile) - 1)
        self._plot.show_column(self._column, len(profile), self._is_held)
        self._picker.show_column(self._column, self._is_held)
        window = exposure_window(snapshot.frame.scene, self._column)
        level, has_edges = float(profile[self._column]), snapshot.has_edges
        self._plot.show_window(window, level, has_edges=has_edges)


class ExplanationView(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self.equations, self.exposure = EquationText(), ExposurePlot()
        splitter = QSplitter(Qt.Orientation.Vertical)
        splitter.addWidget(self.equations)
        splitter.addWidget(self.exposure)
        splitter.setChildrenCollapsible(False)
        splitter.setStretchFactor(0, 3)
        splitter.setStretchFactor(1, 2)
        fill(QVBoxLayout(self), splitter, margins=0)


class ExplanationPane(Pane[Snapshot]):
    def __init__(self, scenes: SceneStore, plot: Plot) -> None:
        self.view = view = ExplanationView()
        super().__init__(view)
        # The exposure plot shows a level of the picture; the equations need no picture.
        self.made_of = {view.exposure: of_snapshot}
        self.picker = ColumnPicker(plot)
        self._equations = EquationController(scenes, view.equations.show_equations)
        exposure = self.exposure = ExposureController(view.exposure, self.picker)
        self.picker.hovered.connect(exposure.hover)
        self.picker.clicked.connect(exposure.click)
        self.picker.stepped.connect(exposure.step)
        self.picker.released.connect(lambda: exposure.hold(False))
        view.exposure.column_chosen.connect(exposure.choose)
        view.exposure.hold_chosen.connect(exposure.hold)

    def set_visible(self, visible: bool) -> None:
        self._equations.set_visible(visible)
        self.exposure.set_visible(visible)

    def show_part(self, part: Snapshot) -> None:
        self.exposure.show_snapshot(part)
