"""The column profile beside the band model's and a photo's."""

from collections.abc import Iterable

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from occ_gui.state.snapshot import Snapshot
from occ_gui.views.plots import (
    BAND,
    PACKETS_IN_VIEW,
    PHOTO,
    REGION,
    SIMULATION,
    THRESHOLD,
    new_plot,
    thin,
)
from occ_gui.widgets.line_legend import LineLegend
from occ_model.arrays import FloatArray
from occ_model.photo.load import Photo

_LEAST_HEIGHT = 76
"""Pixels: in a low window all panes have to share them."""

_SHADE = 40
"""How much of the region's colour lies under the curves, of 255."""


class ProfileView(QWidget):
    """Grey level over column: the simulation, the band model or why there is none, and the photo.

    The plot follows the panel's first packets, or the whole panel, until the user moves it.
    A photo's first column is drawn at the panel's, as its picture is laid over the panel.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._snapshot: Snapshot | None = None
        self._photo: Photo | None = None
        self.plot = new_plot(
            self.tr("Column profile"), self.tr("column"), self.tr("level"), self.palette()
        )
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        # Where several columns share a pixel their extremes are drawn, not one of them by chance.
        self.plot.setDownsampling(auto=True, mode="peak")
        self.plot.setClipToView(True)
        self.legend = LineLegend()
        self._make_curves()
        self.reason = QLabel()
        self.reason.setWordWrap(True)
        self.reason.setAccessibleName(self.tr("Why the band model is undefined"))
        self._make_controls()
        self.plot.getViewBox().sigRangeChangedManually.connect(self._stop_following)
        self._lay_out()

    def _make_curves(self) -> None:
        line = Qt.PenStyle
        pens = {
            "simulation": (self.tr("simulation"), thin(SIMULATION)),
            "band": (self.tr("band model"), thin(BAND, line.DashLine)),
            "photo": (self.tr("photo"), thin(PHOTO)),
            "threshold": (self.tr("threshold"), thin(THRESHOLD, line.DashDotLine)),
        }
        for key, (text, pen) in pens.items():
            self.legend.add_line(key, pen, text)
            self.legend.show_line(key, key == "simulation")
        self.simulation = self.plot.plot(pen=pens["simulation"][1])
        self.band = self.plot.plot(pen=pens["band"][1])
        self.photo = self.plot.plot(pen=pens["photo"][1])
        self.threshold = pg.InfiniteLine(angle=0, pen=pens["threshold"][1])
        shade = QColor(REGION)
        shade.setAlpha(_SHADE)
        self._region = pg.LinearRegionItem(brush=shade, pen=pg.mkPen(None), movable=False)
        self._region.setZValue(-10)
        for item in (self._region, self.threshold):
            item.hide()
            self.plot.addItem(item, ignoreBounds=True)

    def _make_controls(self) -> None:
        self.enhanced = QCheckBox(self.tr("Enhanced"))
        self.enhanced.setToolTip(
            self.tr("Show the simulated column values as they stand in the picture.")
        )
        self.enhanced.toggled.connect(self._redraw)
        self._packets = self._range_button(
            self.tr("{packets} packets").format(packets=PACKETS_IN_VIEW),
            self.tr("Show the panel's first packets, and follow them."),
        )
        self._panel = self._range_button(
            self.tr("Panel"), self.tr("Show all columns of the panel, and follow it.")
        )
        self._packets.setChecked(True)

    def _range_button(self, text: str, tip: str) -> QPushButton:
        button = QPushButton(text)
        button.setCheckable(True)
        button.setToolTip(tip)
        button.clicked.connect(lambda: self._follow(button))
        return button

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self.legend)
        row.addStretch(1)
        for control in (self.enhanced, self._packets, self._panel):
            row.addWidget(control)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.setSpacing(2)
        layout.addLayout(row)
        layout.addWidget(self.reason)
        layout.addWidget(self.plot, 1)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""
        self._snapshot = snapshot
        self._redraw()

    def show_photo(self, photo: Photo | None) -> None:
        """Show this photo's profile in place of the last one, or none."""
        self._photo = photo
        self._redraw()

    def _redraw(self) -> None:
        snapshot = self._snapshot
        if snapshot is None:
            return
        frame, decoded = snapshot.frame, snapshot.decoded
        enhanced = self.enhanced.isChecked()
        profile = frame.enhanced.astype(np.float64) if enhanced else frame.profile
        photo = None if self._photo is None else self._photo.profile
        _draw(self.simulation, profile)
        _draw(self.band, snapshot.band)
        _draw(self.photo, photo, round(snapshot.panel_origin[0]))
        self.reason.setText(snapshot.band_undefined)
        self.reason.setVisible(bool(snapshot.band_undefined))
        self._region.setVisible(decoded.region is not None)
        if decoded.region is not None:
            self._region.setRegion((decoded.region.first_column, decoded.region.last_column))
        self.threshold.setVisible(enhanced and decoded.threshold is not None)
        if decoded.threshold is not None:
            self.threshold.setValue(decoded.threshold)
        for key, visible in {
            "band": snapshot.band is not None,
            "photo": photo is not None,
            "threshold": self.threshold.isVisible(),
        }.items():
            self.legend.show_line(key, visible)
        self._fit_levels([profile, snapshot.band, photo])
        self._fit_columns(snapshot)

    def _fit_levels(self, profiles: Iterable[FloatArray | None]) -> None:
        """Show from black to the largest value, in steps, so that the axis does not tremble."""
        largest = max(float(p.max()) for p in profiles if p is not None)
        step = 20.0
        self.plot.setYRange(0.0, max(step, np.ceil(largest / step) * step), padding=0.06)

    def _fit_columns(self, snapshot: Snapshot) -> None:
        if not (self._packets.isChecked() or self._panel.isChecked()):
            return
        last_column = len(snapshot.frame.profile) - 1
        panel = np.clip(snapshot.frame.corners[:, 0], 0, last_column)
        first, last = float(panel.min()), float(panel.max())
        if last - first < 1.0:  # the panel is out of the picture
            first, last = 0.0, float(last_column)
        if self._packets.isChecked():
            last = min(last, first + PACKETS_IN_VIEW * snapshot.packet_columns)
        self.plot.setXRange(first, max(last, first + 1.0), padding=0.01)

    def _stop_following(self) -> None:
        for button in (self._packets, self._panel):
            button.setChecked(False)

    def _follow(self, clicked: QPushButton) -> None:
        self._stop_following()
        clicked.setChecked(True)
        self._redraw()


def _draw(curve: pg.PlotDataItem, values: FloatArray | None, first_column: int = 0) -> None:
    if values is None:
        curve.setData([], [])
    else:
        curve.setData(first_column + np.arange(len(values), dtype=np.float64), values)
