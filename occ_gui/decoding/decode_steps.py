"""The steps of a decoder, drawn: the signal with its chips, and the run lengths."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QLabel, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.widgets.axes import Axis
from occ_gui.widgets.building import fill
from occ_gui.widgets.colours import BAND, SIMULATION, THRESHOLD, lighten_for, thin_pen
from occ_gui.widgets.columns import PACKETS_IN_VIEW
from occ_gui.widgets.plot import LineLegend, new_plot
from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.decoding import DecodeResult

_CHIP_STRIP_HEIGHT = 0.16
"""Height of the strip of chips below the signal, as a fraction of the signal's range."""

_LEAST_HEIGHT = 104  # pixels, enough for the labels of both axes
_COLOURS = (BAND, SIMULATION)  # colours of the run lengths of zeros and of ones


class _LevelAxis(Axis):
    """An axis without numbers below zero, where the strip of chips lies."""

    def tickStrings(  # noqa: N802 - pyqtgraph's name
        self, values: list[float], scale: float, spacing: float
    ) -> list[str]:
        texts: list[str] = super().tickStrings(values, scale, spacing)
        return [text if value >= 0 else "" for value, text in zip(values, texts, strict=True)]


class SignalPlot(QWidget):
    """The signal, its threshold and the chips read; or the signal folded on one packet.

    A decoder that compares the signal with the forward model of a code folds it; one that undoes
    the exposure shows the equalized light; one that reads a chip sequence shows the measured light
    beside the light predicted from the chips.
    """

    def __init__(self) -> None:
        super().__init__()
        labels = ("Signal and chips", "column of the region", "level")
        self.plot = new_plot(*labels, _LevelAxis("left"))
        self.legend = LineLegend()
        dash = Qt.PenStyle.DashLine
        self.legend.add_line("signal", thin_pen(SIMULATION), "signal")
        self.legend.add_line("threshold", thin_pen(THRESHOLD, dash), "threshold")
        self.legend.add_line("chips", pg.mkPen(SIMULATION, width=8), "chips: lit")
        self.legend.add_line("model", thin_pen(BAND, dash), "model of the code")
        self.signal = self.plot.add_curve(thin_pen(SIMULATION), is_crowded=True)
        self.model = self.plot.add_curve(thin_pen(BAND, dash))
        self.threshold = pg.InfiniteLine(angle=0, pen=thin_pen(THRESHOLD, dash))
        self.chips = pg.BarGraphItem(x0=[], width=[], y0=[], height=[])
        self.plot.follow_palette(
            lambda palette: self.chips.setOpts(brush=lighten_for(palette, SIMULATION))
        )
        for item in (self.threshold, self.chips):
            self.plot.addItem(item, ignoreBounds=True)
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        legend = (self.legend, 0, Qt.AlignmentFlag.AlignLeft)
        fill(QVBoxLayout(self), legend, (self.plot, 1), margins=0, spacing=0)

    def show_result(self, result: DecodeResult, packet_columns: float) -> None:
        """Show the steps of this result, first in two packets of ``packet_columns`` each."""
        is_folded, has_light = result.folded is not None, result.light is not None
        if result.folded is not None and result.model is not None:
            self._show_folded(result.folded, result.model)
        elif result.light is not None and result.light_model is not None:
            self._show_columns(result, result.light, "fraction of full light", packet_columns)
            _set_values(self.model, result.light_model)
        elif result.equalized is not None:
            self._show_columns(result, result.equalized, "light", packet_columns)
        else:
            signal = result.signal if result.signal is not None else np.zeros(1)
            self._show_columns(result, signal, "level", packet_columns)
        self.threshold.setVisible(result.threshold is not None)
        self.chips.setVisible(not is_folded and bool(result.chips.size))
        self.legend.show_line("threshold", result.threshold is not None)
        self.legend.show_line("model", is_folded or has_light)
        self.legend.show_line("chips", self.chips.isVisible())
        self.setVisible(result.signal is not None)

    def _show_folded(self, folded: FloatArray, model: FloatArray) -> None:
        self.plot.setLabel("bottom", "eighth of a chip")
        self.plot.setLabel("left", "lit fraction")
        _set_values(self.signal, folded)
        _set_values(self.model, model)
        self.plot.setXRange(0, len(folded) - 1, padding=0.02)
        self.plot.setYRange(0.0, 1.0, padding=0.05)

    def _show_columns(
        self, result: DecodeResult, signal: FloatArray, label: str, packet_columns: float
    ) -> None:
        self.plot.setLabel("bottom", "column of the region")
        self.plot.setLabel("left", label)
        _set_values(self.signal, signal)
        self.model.setData([], [])
        low, high = float(signal.min()), float(signal.max())
        strip = (high - low or 1.0) * _CHIP_STRIP_HEIGHT
        if result.threshold is not None:
            self.threshold.setValue(result.threshold)
        if result.chip_starts is not None:
            edges = np.append(result.chip_starts, float(len(signal)))
            self._show_chips(result.chips, edges, low, strip)
        span = min(float(len(signal) - 1), PACKETS_IN_VIEW * packet_columns)
        self.plot.setXRange(0, max(span, 1.0), padding=0.02)
        self.plot.setYRange(low - 2 * strip, high, padding=0.04)

    def _show_chips(self, chips: ByteArray, edges: FloatArray, low: float, strip: float) -> None:
        starts, widths = edges[:-1], np.diff(edges)
        is_lit = chips == 1
        self.chips.setOpts(
            x0=starts[is_lit] + 0.05 * widths[is_lit],
            width=0.9 * widths[is_lit],
            y0=np.full(int(is_lit.sum()), low - 1.6 * strip),
            height=np.full(int(is_lit.sum()), strip),
        )


class _CountAxis(Axis):
    """An axis of counts, whose numbers below zero are written without a sign."""

    def tickStrings(  # noqa: N802 - pyqtgraph's name
        self, values: list[float], _scale: float, _spacing: float
    ) -> list[str]:
        return [f"{abs(value):g}" for value in values]


class RunLengthPlot(QWidget):
    """Histograms of the run lengths of ones and of zeros, with the thresholds that split them."""

    def __init__(self) -> None:
        super().__init__()
        labels = ("Run lengths", "run length (columns)", "runs")
        self.plot = new_plot(*labels, _CountAxis("left"))
        title = QLabel("Run lengths: ones up, zeros down, splits dashed")
        self.bars, self.splits = [], []
        for colour in _COLOURS:
            bars = pg.BarGraphItem(x=[], height=[], width=0.8)
            split = self.plot.add_curve(thin_pen(colour, Qt.PenStyle.DashLine))
            self.plot.addItem(bars)
            self.bars.append(bars)
            self.splits.append(split)
        self.plot.follow_palette(self._colour_items)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        fill(QVBoxLayout(self), title, (self.plot, 1), margins=0, spacing=0)

    def _colour_items(self, palette: QPalette) -> None:
        for bars, colour in zip(self.bars, _COLOURS, strict=True):
            bars.setOpts(brush=lighten_for(palette, colour), pen=lighten_for(palette, colour))

    def show_result(self, result: DecodeResult) -> None:
        self.setVisible(result.histograms is not None)
        if result.histograms is None:
            return
        largest_count = max(int(h.counts.max()) for h in result.histograms)
        longest = max(len(h.counts) for h in result.histograms)
        for histogram, sign, bars, split in zip(
            result.histograms, (-1, 1), self.bars, self.splits, strict=True
        ):
            lengths = np.flatnonzero(histogram.counts)
            bars.setOpts(x=lengths, height=sign * histogram.counts[lengths])
            x = [] if histogram.split is None else [histogram.split + 0.5] * 2
            split.setData(x, [0, sign * largest_count][: len(x)])
        self.plot.setXRange(0, longest, padding=0.02)
        self.plot.setYRange(-largest_count, largest_count, padding=0.05)


def _set_values(curve: pg.PlotDataItem, values: FloatArray) -> None:
    curve.setData(np.arange(len(values), dtype=np.float64), values)
