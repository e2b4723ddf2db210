"""Chart of the lamp's modulation over frequency, with the lines of IEEE 1789-2015."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from occ_gui.bands.jobs import ShownBands
from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.contrast import seen_on
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.legend import LineLegend
from occ_gui.widgets.pens import BAND, SIMULATION, thin
from occ_gui.widgets.plot import marker, new_plot

_MODULATIONS = (0.01, 200.0)
_FREQUENCIES = (1.0, 1e4)
"""Ends of the axes, in percent and Hz; the latter reaches on to a lamp that is faster."""

_BEYOND = 2.0

_SAMPLE = QSize(14, 14)
_DASHES, _SIZES = Qt.PenStyle.DashLine, (5.0, 11.0)


class RiskPlot(QWidget):
    """Each sine of the lamp's light and the light as a whole, above or below both lines."""

    def __init__(self) -> None:
        super().__init__()
        self.plot = new_plot(
            "Flicker for the eye", "frequency of the flicker (Hz)", "modulation (%)",
            self.palette(), LogAxis("left"), LogAxis("bottom"),
        )  # fmt: skip
        self.plot.setMouseEnabled(False, False)
        self.low_risk = self.plot.add_curve(thin(BAND))
        self.no_effect = self.plot.add_curve(thin(BAND, _DASHES))
        self.sines, self.whole = (
            self.plot.plot([], [], pen=None, symbol="o", symbolSize=size) for size in _SIZES
        )
        self.plot.dress_with(
            lambda palette: self.sines.setSymbolBrush(pg.mkBrush(seen_on(palette, SIMULATION)))
        )
        self.plot.dress_with(
            lambda palette: self.whole.setSymbolPen(pg.mkPen(palette.text().color(), width=1.5))
        )
        self.whole.setSymbolBrush(pg.mkBrush(None))
        self.sines.setSymbolPen(pg.mkPen(None))
        lines, points = LineLegend(), LineLegend()
        lines.add_line("low", thin(BAND), "below: low risk")
        lines.add_line("none", thin(BAND, _DASHES), "below: no effect")
        points.add_sample("whole", marker("o", _SIZES[1], None), _SAMPLE, "the lamp as a whole")
        points.add_sample("sines", marker("o", _SIZES[0], SIMULATION), _SAMPLE, "its sines")
        self.source = QLabel(
            "Lines of IEEE 1789-2015 as lighting makers quote them: its text was not checked."
        )
        self.source.setWordWrap(True)
        layout = filled(QVBoxLayout(self), margins=0, spacing=2)
        for legend in (lines, points):
            layout.addWidget(legend, alignment=Qt.AlignmentFlag.AlignLeft)
        layout.addWidget(self.plot, 1)
        layout.addWidget(self.source)

    def show_flicker(self, found: ShownBands) -> None:
        eye = found.eye
        for curve, line in (
            (self.no_effect, found.lines.no_effect), (self.low_risk, found.lines.low_risk)
        ):  # fmt: skip
            curve.setData(*np.log10(line).T)
        # Sines of nothing have no place on an axis of powers of ten.
        seen = eye.modulations > _MODULATIONS[0]
        self.sines.setData(np.log10(eye.frequencies[seen]), np.log10(eye.modulations[seen]))
        is_seen = eye.percent_flicker > _MODULATIONS[0]
        self.whole.setData(
            [np.log10(eye.frequency)] if is_seen else [],
            [np.log10(eye.percent_flicker)] if is_seen else [],
        )
        low, high = _FREQUENCIES
        across = np.log10([low, max(high, _BEYOND * eye.frequency)])
        self.plot.setXRange(*across, padding=0)
        self.plot.setYRange(*np.log10(_MODULATIONS), padding=0)
        self.plot.setAccessibleDescription(
            f"The light as a whole: {eye.risk}; each of its sines: {eye.parts_risk}"
        )
