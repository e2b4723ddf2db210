"""What is left of a photo's profile when the simulated one is taken away."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.profile.photo_profile import PhotoProfile
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.plot import PHOTO, THRESHOLD, new_plot, thin
from occ_model.results import Comparison

_LEAST_HEIGHT = 56

_STEPS = (5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 75.0, 100.0, 150.0, 200.0, 255.0)
"""Grey levels that the axis can reach, so that it does not tremble."""


class ResidualPlot(QWidget):
    """Photo less simulation over column, with how alike they are in numbers.

    Parameters
    ----------
    linked
        The plot of the profiles themselves, whose columns stay above those of this one.
    parent
        The parent widget.
    """

    def __init__(self, linked: pg.PlotWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.numbers = ElidedLabel("", Qt.TextElideMode.ElideRight)
        self.numbers.setAccessibleName(self.tr("How alike photo and simulation are"))
        self.plot = new_plot(
            self.tr("Photo less simulation"), self.tr("column"), self.tr("rest"), self.palette()
        )
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self.plot.setDownsampling(auto=True, mode="peak")
        self.plot.setClipToView(True)
        # Linked by pyqtgraph, one would be shifted by what their frames are apart on the screen.
        linked.getViewBox().sigXRangeChanged.connect(self._follow)
        self._linked = linked
        self._follow(linked.getViewBox(), linked.viewRange()[0])
        self.plot.getViewBox().sigRangeChangedManually.connect(self._lead)
        zero = pg.InfiniteLine(angle=0, pen=thin(THRESHOLD, Qt.PenStyle.DashDotLine))
        self.plot.addItem(zero, ignoreBounds=True)
        self.curve = self.plot.add_curve(thin(PHOTO))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(1)
        layout.addWidget(self.numbers)
        layout.addWidget(self.plot, 1)

    def _follow(self, _box: pg.ViewBox, columns: tuple[float, float]) -> None:
        self.plot.setXRange(*columns, padding=0)

    def _lead(self) -> None:
        # As if the user had moved the other one: it follows neither panel nor packets any more.
        self._linked.setXRange(*self.plot.viewRange()[0], padding=0)
        box = self._linked.getViewBox()
        box.sigRangeChangedManually.emit(box.mouseEnabled())

    def show_profile(self, profile: PhotoProfile) -> None:
        """Show what is left, or say why photo and simulation cannot be compared."""
        comparison = profile.comparison
        self.plot.setVisible(comparison is not None)
        if comparison is None:
            self.curve.setData([], [])
            self.numbers.set_full_text(profile.sentence or self.tr("Looking for stripes…"))
            return
        residual = comparison.residual
        columns = comparison.first_column + np.arange(len(residual), dtype=np.float64)
        self.curve.setData(columns, residual)
        largest = float(np.abs(residual).max())
        reach = next((step for step in _STEPS if largest <= step), _STEPS[-1])
        self.plot.setYRange(-reach, reach, padding=0.2)
        ticks = [(level, f"{level:.0f}") for level in (-reach, 0.0, reach)]
        self.plot.getAxis("left").setTicks([ticks])
        self.numbers.set_full_text(self._in_words(comparison))

    def _in_words(self, comparison: Comparison) -> str:
        return self.tr(
            "Photo less simulation: correlation {correlation:.4f}, RMSE {rmse:.2f} grey levels"
        ).format(correlation=comparison.correlation, rmse=comparison.rmse)
