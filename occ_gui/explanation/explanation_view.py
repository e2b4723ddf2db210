"""Why the stripes look as they do: the equations, and the exposure of one column."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from occ_gui.explanation.equation_text import EquationText
from occ_gui.explanation.exposure_plot import ExposurePlot


class ExplanationView(QWidget):
    """The equations with the numbers of the moment over the exposure of a column."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.equations, self.exposure = EquationText(), ExposurePlot()
        panes = QSplitter(Qt.Orientation.Vertical)
        panes.addWidget(self.equations)
        panes.addWidget(self.exposure)
        panes.setChildrenCollapsible(False)
        panes.setStretchFactor(0, 3)
        panes.setStretchFactor(1, 2)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(panes)
