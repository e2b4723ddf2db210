"""Plots of the bars: the map of their least depth, and the chart of the flicker for the eye."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.bands.jobs import SceneBars
from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.building import fill, paragraph
from occ_gui.widgets.colours import BAND, SIMULATION, lighten_for, thin_pen
from occ_gui.widgets.plot import LineLegend, marker, new_plot
from occ_model.results.bands import NO_BARS_DEPTH, format_depth
from occ_model.scene.parameters import quantity
from occ_model.scene.units import HERTZ, SECOND, Unit

_VALLEYS = 8  # number of white lines; further ones would lie closer together than the cells

_DEPTH_RANGE = (NO_BARS_DEPTH, 1.0)  # depths at the ends of the colours

_TICK_DIGITS = (1.0, 3.0)  # leading digits of the numbers on the axes

_MODULATION_RANGE = (0.01, 200.0)
_FREQUENCY_RANGE = (1.0, 1e4)
"""Ends of the axes, in percent and Hz; for a faster lamp, the axis of frequencies is longer."""

_FREQUENCY_MARGIN = 2.0

_SAMPLE_SIZE = QSize(14, 14)
_DASHES, _SYMBOL_SIZES = Qt.PenStyle.DashLine, (5.0, 11.0)


class DepthPlot(QWidget):
    """The map of the least depth; a click sets the exposure."""

    chosen = Signal(float)  # the exposure time that the user chooses, in seconds

    def __init__(self) -> None:
        super().__init__()
        self.plot = new_plot(
            "Least depth of the bars", "", quantity("exposure_time").label,
        )  # fmt: skip
        self.image = pg.ImageItem()
        self.image.setLookupTable(pg.colormap.get("viridis").getLookupTable(nPts=256))
        self.plot.addItem(self.image)
        self.plot.setMouseEnabled(False, False)
        margin = self.fontMetrics().height() / 2.0  # for the outer halves of the last numbers
        self.plot.getPlotItem().layout.setContentsMargins(0.0, margin, 2.0 * margin, margin)
        self.valleys = [self.plot.plot(pen=thin_pen(QColor("white"))) for _ in range(_VALLEYS)]
        self.setting = self.plot.plot(
            [], [], pen=None, symbol="o", symbolSize=10, symbolBrush="w", symbolPen="k"
        )
        self.legend = paragraph(
            "Dark: some setting within the cell shows no bars, less than "
            f"{format_depth(NO_BARS_DEPTH)}; yellow: 100 % or more. White lines: exposures of a "
            "whole number of the lamp's periods. A click sets the exposure."
        )
        fill(QVBoxLayout(self), (self.plot, 1), self.legend, margins=0)
        self.plot.scene().sigMouseClicked.connect(self._on_click)

    def show_depths(self, bars: SceneBars) -> None:
        depths = bars.map
        low, high = np.log10(_DEPTH_RANGE)
        fractions = (np.log10(np.maximum(depths.least, _DEPTH_RANGE[0])) - low) / (high - low)
        self.image.setImage(np.clip(255.0 * fractions, 0.0, 255.0), levels=(0.0, 255.0))
        left, right = np.log10(depths.frequencies[[0, -1]])
        bottom, top = np.log10(depths.exposures[[0, -1]])
        self.image.setRect(QRectF(left, bottom, right - left, top - bottom))
        self.plot.setLabel("bottom", depths.axis.label)
        self._name_ticks("bottom", HERTZ, _TICK_DIGITS, left, right)
        self._name_ticks("left", SECOND, _TICK_DIGITS[:1], bottom, top)
        self.plot.setXRange(left, right, padding=0)
        self.plot.setYRange(bottom, top, padding=0)
        for order, line in enumerate(self.valleys, 1):
            line.setVisible(depths.period > 0)
            periods = np.log10(order * (depths.period or 1.0))
            line.setData([left, right], [periods - left, periods - right])
        self.setting.setData(
            [np.log10(depths.axis.frequency)], [np.log10(bars.scene.camera.exposure_time)]
        )
        self.plot.setAccessibleDescription(bars.advice.sentence)

    def _name_ticks(
        self, side: str, unit: Unit, digits: tuple[float, ...], low: float, high: float
    ) -> None:
        powers = range(int(np.floor(low)), int(np.ceil(high)) + 1)
        values = [digit * 10.0**power for power in powers for digit in digits]
        self.plot.getAxis(side).setTicks([[(float(np.log10(v)), unit.format(v)) for v in values]])

    def _on_click(self, event: object) -> None:
        place: QPointF = self.plot.getViewBox().mapSceneToView(event.scenePos())  # type: ignore[attr-defined]
        # The numbers beside the map are within the view box's scene, but not within the map.
        if self.image.mapRectToView(self.image.boundingRect()).contains(place):
            self.chosen.emit(10.0 ** float(place.y()))


class RiskPlot(QWidget):
    """The flicker of the lamp and of each sine of its light, with the two lines of IEEE 1789."""

    def __init__(self) -> None:
        super().__init__()
        self.plot = new_plot(
            "Flicker for the eye", "frequency of the flicker (Hz)", "modulation (%)",
            LogAxis("left"), LogAxis("bottom"),
        )  # fmt: skip
        self.plot.setMouseEnabled(False, False)
        self.low_risk = self.plot.add_curve(thin_pen(BAND))
        self.no_effect = self.plot.add_curve(thin_pen(BAND, _DASHES))
        self.sines, self.lamp = (
            self.plot.plot([], [], pen=None, symbol="o", symbolSize=size) for size in _SYMBOL_SIZES
        )
        self.plot.follow_palette(
            lambda palette: self.sines.setSymbolBrush(pg.mkBrush(lighten_for(palette, SIMULATION)))
        )
        self.plot.follow_palette(
            lambda palette: self.lamp.setSymbolPen(pg.mkPen(palette.text().color(), width=1.5))
        )
        self.lamp.setSymbolBrush(pg.mkBrush(None))
        self.sines.setSymbolPen(pg.mkPen(None))
        lines, points = LineLegend(), LineLegend()
        lines.add_line("low", thin_pen(BAND), "below: low risk")
        lines.add_line("none", thin_pen(BAND, _DASHES), "below: no effect")
        points.add_sample(
            "whole", marker("o", _SYMBOL_SIZES[1], None), _SAMPLE_SIZE, "the lamp as a whole"
        )
        points.add_sample(
            "sines", marker("o", _SYMBOL_SIZES[0], SIMULATION), _SAMPLE_SIZE, "its sines"
        )
        self.source = paragraph(
            "Lines of IEEE 1789-2015 as manufacturers quote them; not checked against its text."
        )
        legends = ((legend, 0, Qt.AlignmentFlag.AlignLeft) for legend in (lines, points))
        fill(QVBoxLayout(self), *legends, (self.plot, 1), self.source, margins=0, spacing=2)

    def show_flicker(self, bars: SceneBars) -> None:
        eye = bars.eye
        for curve, line in (
            (self.no_effect, bars.lines.no_effect), (self.low_risk, bars.lines.low_risk)
        ):  # fmt: skip
            curve.setData(*np.log10(line).T)
        # A logarithmic axis has no place for sines without amplitude.
        is_drawn = eye.modulations > _MODULATION_RANGE[0]
        self.sines.setData(np.log10(eye.frequencies[is_drawn]), np.log10(eye.modulations[is_drawn]))
        has_flicker = eye.percent_flicker > _MODULATION_RANGE[0]
        self.lamp.setData(
            [np.log10(eye.frequency)] if has_flicker else [],
            [np.log10(eye.percent_flicker)] if has_flicker else [],
        )
        low, high = _FREQUENCY_RANGE
        x_range = np.log10([low, max(high, _FREQUENCY_MARGIN * eye.frequency)])
        self.plot.setXRange(*x_range, padding=0)
        self.plot.setYRange(*np.log10(_MODULATION_RANGE), padding=0)
        self.plot.setAccessibleDescription(
            f"The light as a whole: {eye.risk}; each of its sines: {eye.parts_risk}"
        )
