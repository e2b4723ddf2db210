"""Row of the profile: grey level over column, of simulation, band model and photo."""

from typing import TypeVar

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen

from occ_gui.simulation.snapshot import ColumnView
from occ_gui.story.column_axis import RIGHT, ColumnAxis, Crosshair
from occ_gui.story.column_facts import threshold_levels
from occ_gui.story.curve_lines import DASH, keep_extremes, make_lines
from occ_gui.story.story_row import StoryRow
from occ_gui.values.photo_results import PhotoProfile
from occ_gui.widgets.colours import BAND, PHOTO, SIMULATION, THRESHOLD, lighten_for, mix_colours
from occ_gui.widgets.columns import round_level_up
from occ_model.arrays import LARGEST_BYTE, FloatArray
from occ_model.results.decoding import DecodeResult

_Level = TypeVar("_Level", float, FloatArray)  # one level, or one for each column

_LEAST_HEIGHT = 56
_STEPS = (10.0, 20.0, 50.0, 100.0)  # grey levels between two numbers on the axis
_LEAST_SPACING = 26  # fewest pixels between two numbers on the axis

_GRID_ALPHA = 38
_SHADE = 22 / 255
"""Fraction of the text's colour in the shade over columns that the decoder does not read."""

_WIDTH, _THIN = 2.0, 1.2  # pen widths in pixels
_CROWDED_COLUMNS = 2  # columns per screen pixel above which a curve is thinner


class ProfileRow(StoryRow):
    """The profiles of simulation, band model (dashed) and photo, and the decoder's threshold."""

    def __init__(self, axis: ColumnAxis, crosshair: Crosshair) -> None:
        super().__init__("Profile", axis, crosshair)
        self.setMinimumHeight(_LEAST_HEIGHT)
        self._reading: ColumnView | None = None
        self._result: DecodeResult | None = None
        self._photo: PhotoProfile | None = None
        self._picture_kind = "camera"
        self._top = LARGEST_BYTE
        self.threshold: tuple[float, float] | None = None
        """The levels between which the decoder's threshold lies; None if it has none."""

    def show_reading(self, reading: ColumnView, result: DecodeResult) -> None:
        self._reading, self._result = reading, result
        self._update()

    def show_photo(self, photo: PhotoProfile | None) -> None:
        self._photo = photo
        self._update()

    def choose_picture(self, picture_kind: str) -> None:
        self._picture_kind = picture_kind
        self._update()

    @property
    def levels(self) -> FloatArray | None:
        is_enhanced = self._picture_kind != "camera"
        return None if self._reading is None else self._reading.levels(enhanced=is_enhanced)

    @property
    def band(self) -> FloatArray | None:
        """The band model's level of each column, None where it is undefined."""
        is_enhanced = self._picture_kind != "camera"
        return None if self._reading is None else self._reading.band_levels(enhanced=is_enhanced)

    @property
    def photo(self) -> tuple[FloatArray, FloatArray] | None:
        """The columns of the photo on the simulated picture, and their levels."""
        return None if self._photo is None else self._photo.curve

    @property
    def is_photo_fitted(self) -> bool:
        """Whether the photo is drawn with the mean and the contrast of the simulation."""
        return self._photo is not None and self._photo.comparison is not None

    def _find_threshold(self) -> tuple[float, float] | None:
        """Return the decoder's threshold on the scale of the levels that are shown."""
        levels, result = self.levels, self._result
        if levels is None or result is None or result.threshold is None:
            return None
        threshold = threshold_levels(levels, result)
        if threshold is None or self._picture_kind == "camera":
            return threshold
        return result.threshold, result.threshold

    def _update(self) -> None:
        """Find the threshold, scale the axis to the largest level, and redraw what has changed."""
        # Computed once: the legend and each redraw use it.
        self.threshold = self._find_threshold()
        photo = self.photo
        curves = (self.levels, self.band, None if photo is None else photo[1])
        largest = max((float(curve.max()) for curve in curves if curve is not None), default=0.0)
        self._top = round_level_up(largest)
        region = None if self._result is None else self._result.region
        self.redraw_if_changed(*curves, self.threshold, region, self._photo)

    def y_of(self, level: _Level, area: QRectF) -> _Level:
        inner = area.adjusted(0, 8, 0, -8)
        return inner.bottom() - level / self._top * inner.height()

    def draw(self, painter: QPainter, area: QRectF) -> None:
        reading, levels = self._reading, self.levels
        if reading is None or levels is None:
            return
        self._shade_outside(painter, area)
        self._draw_grid(painter, area)
        self._draw_threshold(painter, area)
        columns = np.arange(len(levels), dtype=np.float64)
        self._draw_curve(painter, area, columns, levels, SIMULATION)
        if self.band is not None:  # drawn above it, so that both are visible where they agree
            self._draw_curve(painter, area, columns, self.band, BAND, dash=DASH)
        if self.photo is not None:  # above both, and thinner
            self._draw_curve(painter, area, *self.photo, PHOTO, width=_THIN)

    def _draw_curve(
        self,
        painter: QPainter,
        area: QRectF,
        columns: FloatArray,
        levels: FloatArray,
        colour: QColor,
        *,
        dash: tuple[float, float] | None = None,
        width: float = _WIDTH,
    ) -> None:
        cells = round(area.width() * self.devicePixelRatioF())
        is_crowded = self.axis.span > _CROWDED_COLUMNS * cells
        columns, levels = keep_extremes(columns, levels, self.axis.first, self.axis.last, cells)
        if len(columns) < 2:
            return
        xs, ys = self.xs_of(columns), self.y_of(levels, area)
        pen = QPen(lighten_for(self.palette(), colour), _THIN if is_crowded else width)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if dash is not None:
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        painter.setPen(pen)
        painter.drawLines(make_lines(xs, ys, dash))

    def _shade_outside(self, painter: QPainter, area: QRectF) -> None:
        region = None if self._result is None else self._result.region
        if region is None:
            return
        ink, paper = self.colour(QPalette.ColorRole.Text), self.colour(QPalette.ColorRole.Base)
        shade = mix_colours(ink, paper, _SHADE)  # an opaque colour fills many times faster
        left, right = self.x_of(region.first_column - 0.5), self.x_of(region.last_column - 0.5)
        for low, high in ((area.left(), left), (right, area.right())):
            if low < high:
                painter.fillRect(QRectF(low, area.top(), high - low, area.height()), shade)

    def _list_ticks(self, area: QRectF) -> list[float]:
        most_ticks = (area.height() - 16) / _LEAST_SPACING
        step = next((step for step in _STEPS if self._top / step <= most_ticks), _STEPS[-1])
        return [step * multiple for multiple in range(int(self._top / step) + 1)]

    def _draw_grid(self, painter: QPainter, area: QRectF) -> None:
        faint = QColor(self.colour(QPalette.ColorRole.Text))
        faint.setAlpha(_GRID_ALPHA)
        painter.setPen(QPen(faint, 1))
        for level in self._list_ticks(area):
            y = round(self.y_of(level, area)) + 0.5
            painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))

    def _draw_threshold(self, painter: QPainter, area: QRectF) -> None:
        threshold = self.threshold
        if threshold is None:
            return
        colour = lighten_for(self.palette(), THRESHOLD)
        low, high = (self.y_of(level, area) for level in threshold)
        painter.setPen(QPen(colour, 1.5, Qt.PenStyle.DashDotLine))
        y = (low + high) / 2
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))

    def draw_gutter(self, painter: QPainter, area: QRectF) -> None:
        painter.setPen(self.colour(QPalette.ColorRole.WindowText))
        unit = QRectF(4, 3 + painter.fontMetrics().lineSpacing(), area.left(), self.height())
        left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop
        painter.drawText(unit, left, "grey\nlevel")
        for level in self._list_ticks(area):
            rect = QRectF(0, self.y_of(level, area) - 8, area.left() - 6, 16)
            painter.drawText(rect, RIGHT, f"{level:g}")

    def draw_value_mark(self, painter: QPainter, column: int, area: QRectF) -> None:
        levels = self.levels
        if levels is None or not 0 <= column < len(levels):
            return
        point = QPointF(self.x_of(column), self.y_of(float(levels[column]), area))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self.colour(QPalette.ColorRole.Base), 1.5))
        painter.setBrush(lighten_for(self.palette(), SIMULATION))
        painter.drawEllipse(point, 4.5, 4.5)
