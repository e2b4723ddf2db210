"""Pane of the column profile: simulation, band model and photo, and their residual."""

from functools import cached_property

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QPalette, QShowEvent
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.profile.below_profile import ChipStrip, ResidualPlot
from occ_gui.simulation.band_drift import drift_sentence
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_gui.values.photo_results import PhotoProfile
from occ_gui.widgets.building import check_box, fill, paragraph, push_button
from occ_gui.widgets.colours import BAND, BEFORE, PHOTO, SIMULATION, THRESHOLD, thin_pen
from occ_gui.widgets.columns import PACKETS_IN_VIEW, first_periods, round_level_up
from occ_gui.widgets.event_filters import call_at
from occ_gui.widgets.plot import LineLegend, new_plot
from occ_model.arrays import FloatArray
from occ_model.results.decoding import PAPER_DECODER
from occ_model.scene.scene import Transmitter

_LEAST_HEIGHT = 76  # in pixels; panes share the height of a low window

_AXIS_WIDTH = 52
_LONGEST_LEVEL, _AXIS_GAPS = "-200", 14
"""The longest number of an axis, and the pixels between its name, numbers and ticks."""

_SHADE = 20  # opacity, of 255, of the shade over the columns that are not read

_BEYOND_ANY_PICTURE = 1e7  # a column


class ProfileView(QWidget):
    """Grey level over column: the simulation, the band model or why it is undefined, and the photo.

    The plot follows the first packets of the panel, or the whole panel, until the user moves it.
    Below it is the residual, the open photo minus the simulation.
    """

    enhanced_chosen = Signal(bool)  # whether the user chose the enhanced columns

    def __init__(self) -> None:
        super().__init__()
        self.reading: Reading | None = None
        self._must_redraw = False
        self._photo: PhotoProfile | None = None
        self.photo_levels: FloatArray | None = None
        self._before: Snapshot | None = None
        self._before_levels: FloatArray | None = None
        self._simulated_levels: tuple[FloatArray | None, ...] = ()
        self.plot = new_plot("Column profile", "column", "level")
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self.plot.show_extremes()
        self.legend = LineLegend()
        self._make_curves()
        self.reason = paragraph(name="Why the band model drifts or is undefined")
        self._make_controls()
        self.plot.getAxis("left").setWidth(self._measure_axis())
        self.plot.getViewBox().sigRangeChangedManually.connect(self._stop_following)
        self._lay_out()
        call_at(self, self._widen_axes, QEvent.Type.FontChange)

    def _make_curves(self) -> None:
        line = Qt.PenStyle
        pens = {
            "simulation": ("simulation", thin_pen(SIMULATION)),
            "before": ("before", thin_pen(BEFORE)),
            "band": ("band model", thin_pen(BAND, line.DashLine)),
            "photo": ("photo", thin_pen(PHOTO)),
            # Scaled to the mean and contrast of the simulation, as the camera's gain is unknown.
            "fitted": ("photo, fitted levels", thin_pen(PHOTO)),
            "threshold": ("threshold", thin_pen(THRESHOLD, line.DashDotLine)),
        }
        for key, (text, pen) in pens.items():
            self.legend.add_line(key, pen, text)
            self.legend.show_line(key, key == "simulation")
        self.before = self.plot.add_curve(pens["before"][1])  # below all others
        self.simulation = self.plot.add_curve(pens["simulation"][1])
        self.band = self.plot.add_curve(pens["band"][1])
        self.photo = self.plot.add_curve(pens["photo"][1])
        self.threshold = pg.InfiniteLine(angle=0, pen=pens["threshold"][1])
        # As in the story, the columns that the decoder does not read are shaded.
        self.shades = tuple(
            pg.LinearRegionItem(pen=pg.mkPen(None), movable=False) for _ in range(2)
        )
        for item in (*self.shades, self.threshold):
            item.setZValue(-10)
            item.hide()
            self.plot.addItem(item, ignoreBounds=True)
        self.plot.follow_palette(self._colour_items)

    def _colour_items(self, palette: QPalette) -> None:
        shade = palette.color(QPalette.ColorRole.Text)
        shade.setAlpha(_SHADE)
        for item in self.shades:
            item.setBrush(shade)

    def _make_controls(self) -> None:
        self.enhanced = check_box(
            "Enhanced",
            "Show every curve after the receiver's contrast enhancement: the simulation as the "
            "decoders read it, every other curve by its own histogram.",
            self._draw_before,
        )
        self.enhanced.toggled.connect(self._redraw)
        self.enhanced.toggled.connect(self.enhanced_chosen)
        self._packets = self._make_range_button(*first_periods(Transmitter()))
        tip = "Show all columns of the panel, and follow it."
        self._panel = self._make_range_button("Panel", tip)
        self._packets.setChecked(True)

    def _make_range_button(self, text: str, tip: str) -> QPushButton:
        button = push_button(text, tip, lambda: self._follow(button))
        button.setCheckable(True)
        return button

    def _lay_out(self) -> None:
        row = fill(QHBoxLayout(), self.legend, None, self.enhanced, self._packets, self._panel)
        layout = self._rows = fill(
            QVBoxLayout(self), row, self.reason, (self.plot, 3), margins=4, spacing=2
        )
        self.chips = ChipStrip(self.plot, self._measure_axis())
        layout.addWidget(self.chips)

    def _measure_axis(self) -> int:
        """Return the width of the left axes: room for the rotated name and the longest number."""
        metrics = self.fontMetrics()
        needed = metrics.height() + metrics.horizontalAdvance(_LONGEST_LEVEL) + _AXIS_GAPS
        return max(_AXIS_WIDTH, needed)

    @cached_property
    def residual(self) -> ResidualPlot:
        """The plot of photo minus simulation, made when the first photo is shown."""
        residual = ResidualPlot(self.plot)
        # So that the columns of both plots are aligned.
        residual.plot.getAxis("left").setWidth(self._measure_axis())
        self._rows.addWidget(residual, 2)
        return residual

    def _widen_axes(self) -> None:
        width = self._measure_axis()
        self.plot.getAxis("left").setWidth(width)
        self.chips.copy.setFixedWidth(width)
        if "residual" in vars(self):
            self.residual.plot.getAxis("left").setWidth(width)

    def _arrange_plots(self) -> None:
        if self._photo is None and "residual" not in vars(self):
            return  # no photo has been opened yet
        has_residual = self._photo is not None and self._photo.comparison is not None
        self.residual.setVisible(self._photo is not None)
        # A sentence in place of the residual needs only the height of a line.
        policy = self.residual.sizePolicy()
        vertical = QSizePolicy.Policy.Preferred if has_residual else QSizePolicy.Policy.Maximum
        policy.setVerticalPolicy(vertical)
        self.residual.setSizePolicy(policy)
        self.plot.show_axis_name(not has_residual)
        self.plot.getAxis("bottom").setStyle(showValues=not has_residual)

    def show_reading(self, reading: Reading) -> None:
        """Show a reading; a hidden pane waits for the one of the exact picture."""
        self.reading = reading
        text, tip = first_periods(reading.scene.transmitter)
        if text != self._packets.text():  # Qt lays the row out again even if the text is the same
            self._packets.setText(text)
            self._packets.setToolTip(tip)
        self._must_redraw = reading.source != "picture" and not self.isVisible()
        if not self._must_redraw:
            self._redraw()

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        super().showEvent(event)
        if self._must_redraw:
            self._redraw()

    def show_photo_profile(self, profile: PhotoProfile | None) -> None:
        self._photo = profile
        columns, self.photo_levels = (None, None) if profile is None else profile.curve
        _draw(self.photo, self.photo_levels, columns)
        if profile is not None:
            self.chips.place(profile.first_column, profile.scale)
        is_fitted = profile is not None and profile.comparison is not None
        self.legend.show_line("photo", profile is not None and not is_fitted)
        self.legend.show_line("fitted", is_fitted)
        self._update_before()
        self._arrange_plots()
        if profile is not None:
            self.residual.show_profile(profile)
        self._fit_levels()
        if self.reading is not None:
            self._fit_columns(self.reading)

    def _redraw(self) -> None:
        reading, self._must_redraw = self.reading, False
        if reading is None:
            return
        paper = reading.results.get(PAPER_DECODER)
        threshold = None if paper is None else paper.threshold
        enhanced = self.enhanced.isChecked()
        profile = reading.levels(enhanced=enhanced)
        band = reading.band_levels(enhanced=enhanced)
        _draw(self.simulation, profile)
        _draw(self.band, band)
        self.reason.setText(reading.band_undefined or drift_sentence(reading))
        self.reason.setVisible(bool(self.reason.text()))
        region = reading.region
        for item in self.shades:
            item.setVisible(region is not None)
        if region is not None:
            left, right = self.shades
            left.setRegion((-_BEYOND_ANY_PICTURE, region.first_column))
            right.setRegion((region.last_column, _BEYOND_ANY_PICTURE))
        self.threshold.setVisible(enhanced and threshold is not None)
        if threshold is not None:
            self.threshold.setValue(threshold)
        for key, visible in {
            "band": reading.band is not None,
            "threshold": self.threshold.isVisible(),
        }.items():
            self.legend.show_line(key, visible)
        self._simulated_levels = (profile, band)
        self._fit_levels()
        self._fit_columns(reading)

    def show_before(self, snapshot: Snapshot) -> None:
        self._before = snapshot
        self._draw_before()
        self._update_before()
        self._fit_levels()

    def _update_before(self) -> None:
        """Show the curve from before the latest step, unless a photo is compared."""
        is_visible = self._before is not None and self.photo_levels is None
        self.before.setVisible(is_visible)
        self.legend.show_line("before", is_visible)

    def _draw_before(self) -> None:
        if self._before is not None:
            self._before_levels = self._before.levels(enhanced=self.enhanced.isChecked())
            _draw(self.before, self._before_levels)

    def _fit_levels(self) -> None:
        """Set the range from black to the largest level, rounded up."""
        before = self._before_levels if self.photo_levels is None else None
        profiles = (*self._simulated_levels, before, self.photo_levels)
        largest = max(
            (float(profile.max()) for profile in profiles if profile is not None), default=0.0
        )
        self.plot.setYRange(0.0, round_level_up(largest), padding=0.06)

    def _fit_columns(self, reading: Reading) -> None:
        if not (self._packets.isChecked() or self._panel.isChecked()):
            return
        first, last = reading.panel_columns
        if self._packets.isChecked():
            first = self._find_start(first, last)
            last = min(last, first + PACKETS_IN_VIEW * reading.period_columns)
        self.plot.setXRange(first, max(last, first + 1.0), padding=0.01)

    def _find_start(self, first: float, last: float) -> float:
        """Return the first column in view: the photo's, if it lies to the right of ``first``."""
        comparison = None if self._photo is None else self._photo.comparison
        if comparison is None or not first < comparison.first_column < last:
            return first
        return float(comparison.first_column)

    def columns_in_view(self) -> tuple[int, int]:
        """Return the first visible column, and the one after the last."""
        columns = 0 if self.reading is None else len(self.reading.profile)
        low, high = self.plot.viewRange()[0]
        first = min(max(int(np.ceil(low)), 0), max(columns - 2, 0))
        return first, min(max(int(high) + 1, first + 2), columns)

    def level_at(self, column: int) -> float | None:
        levels = self._simulated_levels[0] if self._simulated_levels else None
        if levels is None or not 0 <= column < len(levels):
            return None
        return float(levels[column])

    def _stop_following(self) -> None:
        for button in (self._packets, self._panel):
            button.setChecked(False)

    def _follow(self, clicked: QPushButton) -> None:
        self._stop_following()
        clicked.setChecked(True)
        self._redraw()


def _draw(
    curve: pg.PlotDataItem, values: FloatArray | None, columns: FloatArray | None = None
) -> None:
    """Draw a curve, by default from column 0 on, unless it is drawn already.

    Painting takes longer than comparing.
    """
    values = np.empty(0) if values is None else values
    columns = np.arange(len(values), dtype=np.float64) if columns is None else columns
    drawn = curve.getOriginalDataset()
    if drawn[0] is None or not all(map(np.array_equal, drawn, (columns, values))):
        curve.setData(columns, values)
