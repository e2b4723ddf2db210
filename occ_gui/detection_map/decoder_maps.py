"""Maps of the decoders side by side, or of their difference, with a colour bar and a legend."""

import math
from collections.abc import Collection, Sequence

import numpy as np
from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QIcon, QImage, QPainter, QPalette, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QToolButton, QWidget

from occ_gui.detection_map.colour_map import (
    DIFFERENCES,
    RATES,
    ColourBar,
    colour_table,
    make_image,
    to_colours,
)
from occ_gui.detection_map.map_plot import STYLES, MapPlot, Point
from occ_gui.detection_map.rate_map import LINES, RateMap, TheoryFields
from occ_gui.widgets.building import fill, name_widget
from occ_gui.widgets.event_filters import call_at
from occ_model.arrays import FloatArray
from occ_model.results.sweep_request import ShownQuantity
from occ_model.scene.parameters import quantity
from occ_model.scene.recording import FRAME_RATE

_SCALES = {RATES: (0.0, 100.0), DIFFERENCES: (-100.0, 100.0)}
"""Limits of each colour map, in percent."""

_MOST_MAPS_IN_A_ROW, _LEAST_HEIGHT_OF_TWO_ROWS = 2, 360
"""Most maps in a row, and the least height in pixels of two rows."""


class MapPlots(QWidget):
    picked = Signal(object)  # the point that the user chose, by its indices along both axes
    pointed = Signal(object)  # the point under the mouse, None if there is none

    def __init__(self, decoders: Sequence[str]) -> None:
        super().__init__()
        self._decoders = tuple(decoders)
        self._choice = "both"
        self._shown_quantity: ShownQuantity = "rate"
        self._frames_a_second = FRAME_RATE.default
        self._rates: RateMap | None = None
        self._theory: TheoryFields | None = None
        self._lines: dict[str, list[FloatArray]] = {}
        self._hidden_limits: set[str] = set()
        self._bar_key = ""
        self.plots = tuple(self._new_plot() for _ in decoders)
        self.bar = ColourBar()
        self._grid = QGridLayout()
        self._grid.setSpacing(4)
        self._columns = 0
        fill(QHBoxLayout(self), (self._grid, 1), self.bar, margins=0, spacing=4)
        self._name_plots()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Put the maps side by side, or in two rows if there is enough height for them."""
        super().resizeEvent(event)
        self._place_plots()

    def _place_plots(self) -> None:
        visible = [plot for plot in self.plots if not plot.isHidden()]
        are_in_rows = (
            len(visible) > _MOST_MAPS_IN_A_ROW and self.height() >= _LEAST_HEIGHT_OF_TWO_ROWS
        )
        columns = -(-len(visible) // 2) if are_in_rows else max(len(visible), 1)
        if columns == self._columns:
            return
        self._columns = columns
        for plot in self.plots:
            self._grid.removeWidget(plot)
        for place, plot in enumerate(visible):
            self._grid.addWidget(plot, place // columns, place % columns)
        for row in range(2):
            self._grid.setRowStretch(row, int(row * columns < len(visible)))
        for column in range(len(self.plots)):
            self._grid.setColumnStretch(column, int(column < columns))

    def _new_plot(self) -> MapPlot:
        plot = MapPlot()
        plot.setToolTip("Click a point to set the scene to it, or use the arrow keys and Enter.")
        plot.picked.connect(lambda x, y: self.picked.emit((x, y)))
        plot.pointed.connect(self.pointed)
        return plot

    def _list_names(self) -> tuple[str, ...]:
        return self._decoders if self._choice == "both" else (self._choice,)

    def _name_plots(self) -> None:
        names = self._list_names()
        for plot, name in zip(self.plots, names, strict=False):
            plot.title = self._write_title(name)
            plot.setAccessibleName(f"Detection map: {plot.title}")
        for place, plot in enumerate(self.plots):
            plot.setVisible(place < len(names))
        self._place_plots()
        self._bar_key = ""

    def _write_title(self, name: str) -> str:
        if name == "difference":
            return f"{self._decoders[1]} minus {self._decoders[0]}"
        return name

    def show_choice(self, choice: str) -> None:
        """Show all decoders (``"both"``), one, or the ``"difference"`` of two."""
        self._choice = choice
        self._name_plots()
        self._redraw()

    def show_quantity(self, shown: ShownQuantity, frames_a_second: float) -> None:
        self._shown_quantity, self._frames_a_second = shown, frames_a_second
        self._bar_key = ""
        self._redraw()

    def show_limit(self, limit: str, is_visible: bool) -> None:
        if is_visible:
            self._hidden_limits.discard(limit)
        else:
            self._hidden_limits.add(limit)
        self._show_lines()

    def list_limits(self) -> Collection[str]:
        return [key for key in LINES if self._lines.get(key)]

    def show_axes(self, x: str, y: str) -> None:
        self._rates = self._theory = None
        self._lines = {}
        for plot in self.plots:
            plot.show_axes(quantity(x), quantity(y))

    def show_setting(self, place: Point) -> None:
        for plot in self.plots:
            plot.setting = place
            plot.update()

    def show_map(self, rates: RateMap) -> None:
        self._rates = rates
        if rates.theory is not None and rates.theory is not self._theory:
            self._theory = rates.theory
            self._lines = rates.theory.lines()
        self._redraw()

    def _redraw(self) -> None:
        scheme = DIFFERENCES if self._choice == "difference" else RATES
        low, high = self._find_scale(scheme)
        if self._bar_key != f"{scheme} {high}":
            self._draw_bar(scheme)
        rates = self._rates
        if rates is None:
            return
        sources = rates.find_rate_sources()
        is_unknown = sources[0] < 0
        is_doubtful = rates.find_doubtful()[sources]
        refused = np.where(is_unknown, 0, rates.find_refused()[sources])
        for plot, name in zip(self.plots, self._list_names(), strict=False):
            values = np.where(is_unknown, np.nan, self._find_values(rates, name)[sources])
            image = make_image(to_colours(values, low, high, scheme, is_doubtful))
            plot.show_picture(image, rates.shape, refused)
        self._show_lines()

    def _find_scale(self, scheme: str) -> tuple[float, float]:
        low, high = _SCALES[scheme]
        if self._shown_quantity == "rate":
            return low, high
        rates = self._rates
        largest = 0.0 if rates is None else float(rates.most_bits(self._frames_a_second).max())
        return math.copysign(largest, low) if low else 0.0, largest or 1.0

    def _find_values(self, rates: RateMap, name: str) -> FloatArray:
        if name == "difference":
            return self._select(rates, self._decoders[1]) - self._select(rates, self._decoders[0])
        return self._select(rates, name)

    def _select(self, rates: RateMap, decoder: str) -> FloatArray:
        if self._shown_quantity == "rate":
            return rates.rates(decoder)
        return rates.bits_a_second(decoder, self._frames_a_second)

    def _show_lines(self) -> None:
        hidden = self._hidden_limits
        lines = {limit: curves for limit, curves in self._lines.items() if limit not in hidden}
        for plot in self.plots:
            plot.lines = lines
            plot.update()

    def _draw_bar(self, scheme: str) -> None:
        table = colour_table(scheme)
        low, high = self._find_scale(scheme)
        opaque = np.full((len(table), 1), 255, dtype=np.uint8)
        image: QImage = make_image(np.hstack([table, opaque])[None])
        numbers = tuple(
            (fraction, self._format_number(low + fraction * (high - low), bool(low)))
            for fraction in (0.0, 0.25, 0.5, 0.75, 1.0)
        )
        name = "Fraction of the bits that are read correctly, in percent"
        if scheme == DIFFERENCES:
            name = "Difference of the fractions of bits that are read correctly, in percent"
        if self._shown_quantity == "bits":
            name = "Net bits a second, counting only pictures with every bit read correctly"
        self.bar.show_colours(image, numbers, name)
        self._bar_key = f"{scheme} {high}"

    def _format_number(self, value: float, signed: bool) -> str:
        if self._shown_quantity == "bits":
            return f"{value:+,.0f}" if signed and value else f"{value:,.0f}"
        return f"{value:+.0f} %" if signed and value else f"{value:.0f} %"


_LIMIT_TEXTS = {
    "band": ("t = 1 chip", "The exposure lasts as long as a chip: the limit of the band model."),
    "null": ("null, f = 2/t", "The exposure lasts two chips: alternating chips leave no stripes."),
    "packets": ("two packets", "Below this frequency, two packets do not fit the panel's image."),
    "saturation": ("saturated", "The lit panel reaches the largest grey level."),
}
"""Name and meaning of the line of each limit."""

_SWATCH = QSize(28, 12)


class MapLegend(QWidget):
    toggled = Signal(str, bool)  # the name of a limit, and whether its line is shown

    def __init__(self) -> None:
        super().__init__()
        self.buttons = {key: self._make_button(key, *words) for key, words in _LIMIT_TEXTS.items()}
        fill(QHBoxLayout(self), *self.buttons.values(), (None, 1), margins=0, spacing=2)
        self._draw_swatches()
        kinds = (QEvent.Type.PaletteChange, QEvent.Type.DevicePixelRatioChange)
        call_at(self, self._draw_swatches, *kinds)

    def _make_button(self, key: str, text: str, meaning: str) -> QToolButton:
        style = Qt.ToolButtonStyle.ToolButtonTextBesideIcon
        button = QToolButton(toolButtonStyle=style, autoRaise=True)
        button.setText(text)
        button.setIconSize(_SWATCH)
        name_widget(button, text, meaning).setCheckable(True)
        button.setChecked(True)
        button.setEnabled(False)
        button.toggled.connect(lambda shown: self.toggled.emit(key, shown))
        return button

    def _draw_swatches(self) -> None:
        for key, button in self.buttons.items():
            button.setIcon(QIcon(self._draw_swatch(STYLES[key])))

    def _draw_swatch(self, style: Qt.PenStyle) -> QPixmap:
        scale = self.devicePixelRatioF()
        pixmap = QPixmap(_SWATCH * scale)
        pixmap.setDevicePixelRatio(scale)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.setPen(QPen(self.palette().color(QPalette.ColorRole.WindowText), 2, style))
        painter.drawLine(0, _SWATCH.height() // 2, _SWATCH.width(), _SWATCH.height() // 2)
        painter.end()
        return pixmap

    def enable_limits(self, limits: Collection[str]) -> None:
        for key, button in self.buttons.items():
            button.setEnabled(key in limits)
