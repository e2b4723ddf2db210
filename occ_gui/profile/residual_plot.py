"""Plot of the residual, photo minus simulation, over the columns."""

from typing import TYPE_CHECKING

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.values.photo_results import PhotoProfile
from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.pens import PHOTO, THRESHOLD, thin
from occ_gui.widgets.plot import new_plot
from occ_model.results.match import Comparison

if TYPE_CHECKING:
    from occ_model.photo.reading.load import Photo

_LEAST_HEIGHT = 56

_PADDING = 0.2  # of the axis above and below its last ticks, as a fraction of what is between them

_STEPS = (5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 75.0, 100.0, 150.0, 200.0, 255.0)
"""Grey levels at which the axis can end, so that it rarely changes."""


class ResidualPlot(QWidget):
    """Photo minus simulation over column, with their correlation and RMSE."""

    def __init__(self, linked: pg.PlotWidget) -> None:
        super().__init__()
        self.numbers = ElidedLabel()
        self.numbers.setAccessibleName("Agreement of photo and simulation")
        self.plot = new_plot(
            "Residual, photo minus simulation",
            "column",
            "levels",  # the line above names the residual: a longer label is cut off here
            self.palette(),
        )
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self.plot.setDownsampling(auto=True, mode="peak")
        self.plot.setClipToView(True)
        # pyqtgraph's own link would shift one by the distance of their frames on the screen.
        linked.getViewBox().sigXRangeChanged.connect(self._follow)
        self._linked = linked
        self._follow(linked.getViewBox(), linked.viewRange()[0])
        self.plot.getViewBox().sigRangeChangedManually.connect(self._lead)
        zero = pg.InfiniteLine(angle=0, pen=thin(THRESHOLD, Qt.PenStyle.DashDotLine))
        self.plot.addItem(zero, ignoreBounds=True)
        self.curve = self.plot.add_curve(thin(PHOTO))
        self._photo: Photo | None = None
        self._limit = _STEPS[0]
        """The end of the axis: for one photo it only grows, so that a residual is seen to fall."""
        filled(QVBoxLayout(self), self.numbers, (self.plot, 1), margins=0, spacing=1)

    def _follow(self, _box: pg.ViewBox, columns: tuple[float, float]) -> None:
        self.plot.setXRange(*columns, padding=0)

    def _lead(self) -> None:
        # As if the user had moved the other plot, which then stops following panel or packets.
        self._linked.setXRange(*self.plot.viewRange()[0], padding=0)
        box = self._linked.getViewBox()
        box.sigRangeChangedManually.emit(box.mouseEnabled())

    def show_profile(self, profile: PhotoProfile) -> None:
        comparison = profile.comparison
        self.plot.setVisible(comparison is not None)
        if comparison is None:
            self.curve.setData([], [])
            self.numbers.set_full_text(profile.sentence or "Searching for stripes…")
            return
        residual = comparison.residual
        columns = comparison.first_column + np.arange(len(residual), dtype=np.float64)
        self.curve.setData(columns, residual)
        usual = comparison.usual_residual
        limit = next((step for step in _STEPS if usual <= step), _STEPS[-1])
        if profile.photo is not None and profile.photo is self._photo:
            limit = max(limit, self._limit)
        if not profile.is_outdated:
            self._photo, self._limit = profile.photo, limit
        self.plot.setYRange(-limit, limit, padding=_PADDING)
        ticks = [(level, f"{level:.0f}") for level in (-limit, 0.0, limit)]
        self.plot.getAxis("left").setTicks([ticks])
        self.numbers.set_full_text(self._in_words(comparison, (1.0 + 2.0 * _PADDING) * limit))

    def _in_words(self, comparison: Comparison, shown: float) -> str:
        text = (
            "Residual, photo minus the present scene's simulation: correlation "
            f"{comparison.correlation:.4f} "
            f"as they lie here, RMSE {comparison.rmse:.2f} grey levels"
        )
        if comparison.largest_residual > shown:
            text += f"; at most {comparison.largest_residual:.0f}, beyond the axis"
        return text
