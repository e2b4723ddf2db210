"""Strips along the sliders: the fraction of bits that a decoder would read at each position."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QPainter, QPalette
from PySide6.QtWidgets import QSizePolicy, QSlider

from occ_gui.detection_map.colour_map import RATES, make_image, to_colours
from occ_gui.scene.parameter_rows import QuantityRow
from occ_gui.scene.slider_scale import find_handle_sides, find_handle_travel
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_gui.widgets.outdated_mark import DELAY
from occ_model.scene.parameters import PARAMETERS

IMAGES = 5  # pictures of each position, as many as of a point of the complete map

_HEIGHT = 6
_BAR_SIZE, _GAP = QSize(56, 6), 6  # the bar of the legend, and the pixels beside it

_OUTDATED_OPACITY = 0.35

_HANDLE_MARGIN = 3  # pixels on each side of the handle in the colour of the present scene's rate


@dataclass(frozen=True, slots=True)
class SceneRate:
    """The success rate of the present scene.

    The fraction of the bits that are read correctly, from 0 to 1, with its 95 % interval, the
    number of pictures, and how many of them are read without an error.
    """

    fraction: float
    low: float
    high: float
    images: int
    whole: int


class SliderStrip(PaintedWidget):
    """A thin bar as long as the path of the slider's handle; grey where no rate is known."""

    def __init__(self, slider: QSlider, label: str) -> None:
        super().__init__()
        self.slider = slider
        self.fractions: tuple[float | None, ...] = ()
        self.present_rate: SceneRate | None = None  # the success rate at the scene's own value
        slider.valueChanged.connect(self.update)
        self._is_outdated = self._is_faded = False
        self._fade_timer = QTimer(self, singleShot=True)
        self._fade_timer.setInterval(round(1e3 * DELAY))
        self._fade_timer.timeout.connect(self._fade)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(f"Reading along {label}")
        self._explain()

    def _explain(self) -> None:
        known = [fraction for fraction in self.fractions if fraction is not None]
        text = (
            "Fraction of the bits that the selected decoder reads correctly along this slider, all "
            f"else being equal: violet none, yellow all, grey unknown. A mean over {IMAGES} "
            "pictures with different start times."
        )
        if self.present_rate is not None:
            fraction, low, high = (
                100.0 * value
                for value in (
                    self.present_rate.fraction,
                    self.present_rate.low,
                    self.present_rate.high,
                )
            )
            text += (
                f"\nAt the handle: {fraction:.3g} % of the bits of {self.present_rate.images} "
                f"pictures ({low:.1f} to {high:.1f} %)."
            )
        read_count = sum(fraction > 0.99 for fraction in known)
        summary = f"read at {read_count} of {len(known)} positions"
        if self._is_outdated:
            text += "\nComputing; the colours are of an earlier scene."
            summary = f"earlier scene: {summary}"
        self.setToolTip(text)
        self.setAccessibleDescription(summary)

    def show_fractions(self, fractions: tuple[float | None, ...]) -> None:
        """Show the fraction of bits read at positions of the slider; None where unknown."""
        self.fractions = fractions
        self._explain()
        self.update()

    def show_present_rate(self, rate: SceneRate | None) -> None:
        """Show the rate of the present scene, at the handle; None if unknown."""
        if rate != self.present_rate:
            self.present_rate = rate
            self._explain()
            self.update()

    def show_outdated(self, outdated: bool) -> None:
        """Show whether the fractions are of an earlier scene; if that lasts, they fade."""
        if outdated == self._is_outdated:
            return
        self._is_outdated = outdated
        self._explain()
        if outdated:
            self._fade_timer.start()
        else:
            self._fade_timer.stop()
            self._is_faded = False
            self.update()

    def _fade(self) -> None:
        self._is_faded = True
        self.update()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(20, _HEIGHT)

    def span(self) -> tuple[float, float]:
        """Return the x of the handle's centre at both ends of the slider, in the strip's pixels."""
        first, last = find_handle_travel(self.slider)
        offset = self.slider.x() - self.x()
        return first + offset, last + offset

    def _find_handle_area(self) -> QRectF:
        left, right = find_handle_sides(self.slider)
        offset = self.slider.x() - self.x()
        return QRectF(left + offset, 0, right - left, self.height()).adjusted(
            -_HANDLE_MARGIN, 0, _HANDLE_MARGIN, 0
        )

    def paint_with(self, painter: QPainter) -> None:
        first, last = self.span()
        count = max(2, len(self.fractions))
        half = (last - first) / (count - 1) / 2
        colour_area = QRectF(first - half, 0, last - first + 2 * half, self.height())
        painter.setClipRect(QRectF(first, 0, last - first, self.height()))
        painter.fillRect(colour_area, self.palette().color(QPalette.ColorRole.Midlight))
        if self.fractions:
            painter.setOpacity(_OUTDATED_OPACITY if self._is_faded else 1.0)
            fractions = np.array(
                [[np.nan if fraction is None else fraction] for fraction in self.fractions]
            )
            painter.drawImage(colour_area, make_image(to_colours(fractions, 0.0, 1.0, RATES)))
        painter.setOpacity(1.0)
        if self.present_rate is not None:
            colour = make_image(
                to_colours(np.array([[self.present_rate.fraction]]), 0.0, 1.0, RATES)
            )
            painter.drawImage(self._find_handle_area(), colour)
        painter.setClipping(False)
        painter.setPen(self.palette().color(QPalette.ColorRole.Mid))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(QRectF(first, 0, last - first, self.height() - 1))


class StripLegend(PaintedWidget):
    """A colour bar from "misread" to "read" in one line; a low window has no room for it."""

    def __init__(self) -> None:
        super().__init__()
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self.setAccessibleName("Colours of the sliders")
        meaning = (
            "What the selected decoder would read if only this slider were moved. The colours go "
            "from no bit read correctly to all bits read correctly."
        )
        self.setAccessibleDescription(meaning)
        self.setToolTip(meaning)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(120, self.fontMetrics().height() + 2)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a height of zero, because the sliders are more important."""
        return QSize(120, 0)

    def paint_with(self, painter: QPainter) -> None:
        if self.height() < self.fontMetrics().height():
            return
        painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
        left, middle = 0.0, self.height() / 2
        for text in ("misread", None, "read"):
            if text is None:
                fractions = np.linspace(0.0, 1.0, _BAR_SIZE.width())[:, None]
                place = QRectF(QPointF(left, middle - _BAR_SIZE.height() / 2), _BAR_SIZE.toSizeF())
                painter.drawImage(place, make_image(to_colours(fractions, 0.0, 1.0, RATES)))
                left += _BAR_SIZE.width() + _GAP
                continue
            width = self.fontMetrics().horizontalAdvance(text)
            place = QRectF(left, 0, width + 1, self.height())
            painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, text)
            left += width + _GAP


class SliderStrips(QObject):
    visibility_changed = Signal(bool)  # whether the strips have become visible or hidden

    def __init__(self, rows: dict[str, QuantityRow], parent: QObject | None = None) -> None:
        super().__init__(parent)
        # Other lights send no bits.
        self.rows = {name: row for name, row in rows.items() if PARAMETERS[name].is_of("code")}
        self.legend = StripLegend()  # shown below the sliders
        self.strips: dict[str, SliderStrip] = {}
        for name, row in self.rows.items():
            strip = SliderStrip(row.slider, PARAMETERS[name].in_sentence)
            row.add_track(strip)
            self.strips[name] = strip
        next(iter(self.strips.values())).installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() in (QEvent.Type.Show, QEvent.Type.Hide):
            self.visibility_changed.emit(event.type() == QEvent.Type.Show)
        return super().eventFilter(watched, event)

    def set_visible(self, is_visible: bool) -> None:
        for name, strip in self.strips.items():
            strip.setVisible(is_visible)
            self.rows[name].show_track(is_visible)
        if self.legend.parentWidget() is not None:
            self.legend.setVisible(is_visible)

    def show_present_rate(self, rate: SceneRate | None) -> None:
        for strip in self.strips.values():
            strip.show_present_rate(rate)
