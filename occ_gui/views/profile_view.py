"""The column profile beside the band model's and a photo's."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from occ_gui.state.snapshot import Snapshot
from occ_model.arrays import FloatArray
from occ_model.photo.load import Photo

# Okabe and Ito's colours, told apart by any eye; in grey print the kind of line tells.
_SIMULATION = QColor("#0072B2")
_BAND = QColor("#D55E00")
_PHOTO = QColor("#009E73")
_REGION = QColor(230, 159, 0, 40)
_THRESHOLD = QColor("#CC79A7")


class ProfileView(QWidget):
    """Grey level over column: the simulation, the band model or why there is none, and the photo.

    The plot follows the panel's columns until the user moves it.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._snapshot: Snapshot | None = None
        self._follows = True
        self.enhanced = QCheckBox(self.tr("After contrast enhancement"))
        self.enhanced.setToolTip(
            self.tr("Show the simulated column values as they stand in the picture.")
        )
        self.enhanced.toggled.connect(self._redraw)
        self.follow = QPushButton(self.tr("Show the panel"))
        self.follow.setToolTip(self.tr("Show the columns that the panel covers, and follow it."))
        self.follow.clicked.connect(self._follow_again)
        self.reason = QLabel()
        self.reason.setWordWrap(True)
        self.reason.setAccessibleName(self.tr("Why the band model is undefined"))
        self.plot = _plot(self.tr("column"), self.tr("grey level"))
        self._make_curves()
        self.plot.getViewBox().sigRangeChangedManually.connect(self._stop_following)
        self._lay_out()

    def _make_curves(self) -> None:
        line = Qt.PenStyle
        # Pens of width one: wider ones cost hundreds of milliseconds on a noisy profile.
        self.simulation = self.plot.plot(pen=pg.mkPen(_SIMULATION), name=self.tr("simulation"))
        self.band = self.plot.plot(
            pen=pg.mkPen(_BAND, style=line.DashLine), name=self.tr("band model")
        )
        self.photo = self.plot.plot(pen=pg.mkPen(_PHOTO, style=line.DotLine), name=self.tr("photo"))
        self._region = pg.LinearRegionItem(brush=_REGION, pen=pg.mkPen(None), movable=False)
        self._region.setZValue(-10)
        self._threshold = pg.InfiniteLine(
            angle=0, pen=pg.mkPen(_THRESHOLD, style=line.DashDotLine), label=self.tr("threshold")
        )
        for item in (self._region, self._threshold):
            item.hide()
            self.plot.addItem(item, ignoreBounds=True)

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self.reason, 1)
        row.addWidget(self.enhanced)
        row.addWidget(self.follow)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.addLayout(row)
        layout.addWidget(self.plot, 1)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""
        self._snapshot = snapshot
        self._redraw()

    def show_photo(self, photo: Photo | None) -> None:
        """Show this photo's profile in place of the last one, or none."""
        self.photo.setVisible(photo is not None)
        _draw(self.photo, photo.profile if photo is not None else None)
        self._fit_levels()

    def _redraw(self) -> None:
        snapshot = self._snapshot
        if snapshot is None:
            return
        frame, decoded = snapshot.frame, snapshot.decoded
        enhanced = self.enhanced.isChecked()
        _draw(self.simulation, frame.enhanced.astype(np.float64) if enhanced else frame.profile)
        _draw(self.band, snapshot.band)
        self.reason.setText(snapshot.band_undefined)
        self._region.setVisible(decoded.region is not None)
        if decoded.region is not None:
            self._region.setRegion((decoded.region.first_column, decoded.region.last_column))
        self._threshold.setVisible(enhanced and decoded.threshold is not None)
        if decoded.threshold is not None:
            self._threshold.setValue(decoded.threshold)
        self._fit_levels()
        if self._follows:
            self._show_panel(snapshot)

    def _fit_levels(self) -> None:
        """Show from black to the largest value, in steps, so that the axis does not tremble."""
        curves = (self.simulation, self.band, self.photo)
        values = [c.getOriginalDataset()[1] for c in curves if c.isVisible()]
        largest = max((float(v.max()) for v in values if v is not None and len(v)), default=255.0)
        step = 20.0
        self.plot.setYRange(0.0, max(step, np.ceil(largest / step) * step), padding=0.02)

    def _show_panel(self, snapshot: Snapshot) -> None:
        last_column = len(snapshot.frame.profile) - 1
        columns = np.clip(snapshot.frame.corners[:, 0], 0, last_column)
        first, last = float(columns.min()), float(columns.max())
        if last - first < 1.0:  # the panel is out of the picture
            first, last = 0.0, float(last_column)
        self.plot.setXRange(first, last, padding=0.01)

    def _stop_following(self) -> None:
        self._follows = False

    def _follow_again(self) -> None:
        self._follows = True
        self._redraw()


def _plot(x: str, y: str) -> pg.PlotWidget:
    plot = pg.PlotWidget()
    plot.setBackground(None)
    plot.setMinimumHeight(120)
    plot.setLabel("bottom", x)
    plot.setLabel("left", y)
    plot.addLegend(offset=(-10, 5), colCount=3)
    plot.setMenuEnabled(False)
    plot.hideButtons()
    # Where several columns share a pixel their extremes are drawn, not one of them by chance.
    plot.setDownsampling(auto=True, mode="peak")
    plot.setClipToView(True)
    plot.getViewBox().disableAutoRange()
    return plot


def _draw(curve: pg.PlotDataItem, values: FloatArray | None) -> None:
    if values is None:
        curve.setData([], [])
    else:
        curve.setData(np.arange(len(values), dtype=np.float64), values)
