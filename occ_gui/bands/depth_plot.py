"""Map of the least depth of the bars over frequency and exposure, with the valleys t = k / f."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from occ_gui.bands.jobs import ShownBands
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.pens import thin
from occ_gui.widgets.plot import new_plot
from occ_model.scene.parameters import quantity
from occ_model.scene.units import HERTZ, SECOND, Unit

_VALLEYS = 8  # lines that are drawn: those above lie closer than the cells

_DEPTHS = (1e-3, 1.0)

_KINDS = (1.0, 2.0, 5.0)


class DepthPlot(QWidget):
    """The map; a click takes an exposure."""

    chosen = Signal(float)  # the user takes an exposure time, in seconds

    def __init__(self) -> None:
        super().__init__()
        self.plot = new_plot(
            "Least depth of the bars", quantity("switching_frequency").label,
            quantity("exposure_time").label, self.palette(),
        )  # fmt: skip
        self.image = pg.ImageItem()
        self.image.setLookupTable(pg.colormap.get("viridis").getLookupTable(nPts=256))
        self.plot.addItem(self.image)
        self.plot.setMouseEnabled(False, False)
        room = self.fontMetrics().height() / 2.0  # numbers and descents reach beyond
        self.plot.getPlotItem().layout.setContentsMargins(0.0, room, 2.0 * room, room)
        self.valleys = [self.plot.plot(pen=thin(QColor("white"))) for _ in range(_VALLEYS)]
        self.setting = self.plot.plot(
            [], [], pen=None, symbol="o", symbolSize=10, symbolBrush="w", symbolPen="k"
        )
        self.legend = QLabel(
            "Dark: a small change within the cell shows no bars (0.1 % or less); yellow: 100 % "
            "or more. White lines: whole numbers of the "
            "lamp's periods. A click takes an exposure."
        )
        self.legend.setWordWrap(True)
        filled(QVBoxLayout(self), (self.plot, 1), self.legend, margins=0)
        self.plot.scene().sigMouseClicked.connect(self._on_click)

    def show_depths(self, found: ShownBands) -> None:
        low, high = np.log10(_DEPTHS)
        shares = (np.log10(np.maximum(found.map.least, _DEPTHS[0])) - low) / (high - low)
        self.image.setImage(np.clip(255.0 * shares, 0.0, 255.0), levels=(0.0, 255.0))
        left, right = np.log10(found.map.frequencies[[0, -1]])
        bottom, top = np.log10(found.map.exposures[[0, -1]])
        self.image.setRect(QRectF(left, bottom, right - left, top - bottom))
        self._name_ticks("bottom", HERTZ, _KINDS, left, right)
        self._name_ticks("left", SECOND, _KINDS[:1], bottom, top)
        self.plot.setXRange(left, right, padding=0)
        self.plot.setYRange(bottom, top, padding=0)
        for order, line in enumerate(self.valleys, 1):
            above = np.log10(order * found.map.period)
            line.setData([left, right], [above - left, above - right])
        scene = found.scene
        self.setting.setData(
            [np.log10(scene.transmitter.switching_frequency)],
            [np.log10(scene.camera.exposure_time)],
        )
        self.plot.setAccessibleDescription(
            f"Bars vanish at whole multiples of {SECOND.format(found.advice.valley, 4)}"
        )

    def _name_ticks(
        self, side: str, unit: Unit, kinds: tuple[float, ...], low: float, high: float
    ) -> None:
        powers = range(int(np.floor(low)), int(np.ceil(high)) + 1)
        values = [kind * 10.0**power for power in powers for kind in kinds]
        self.plot.getAxis(side).setTicks([[(float(np.log10(v)), unit.format(v)) for v in values]])

    def _on_click(self, event: object) -> None:
        place: QPointF = self.plot.getViewBox().mapSceneToView(event.scenePos())  # type: ignore[attr-defined]
        # The numbers beside the map are within the view box's scene, but not within the map.
        if self.image.mapRectToView(self.image.boundingRect()).contains(place):
            self.chosen.emit(10.0 ** float(place.y()))
