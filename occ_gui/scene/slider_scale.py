"""Scale under a slider: its end values, and marks where the picture changes qualitatively."""

from collections.abc import Sequence
from itertools import combinations, product
from typing import TypeAlias

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QHelpEvent, QPainter, QPalette, QPen
from PySide6.QtWidgets import QSizePolicy, QSlider, QStyle, QStyleOptionSlider, QToolTip

from occ_gui.widgets.building import resize_font
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_model.results.teaching import MarkedValue
from occ_model.scene.parameter_kinds import Quantity

_TEXT_SCALE = 0.85
_TICK, _GAP = 4.0, 4.0
_NAME_OVERHANG = 3.0  # pixels by which a name beside its mark extends to the other side

_DIGITS = 4
_Text: TypeAlias = tuple[str, QRectF]

_TOOLTIP_DISTANCE = 6.0  # pixels from a mark within which its tooltip is shown


class SliderScale(PaintedWidget):
    """The end values of a slider, and its marks with their names where there is space."""

    def __init__(self, slider: QSlider, quantity: Quantity) -> None:
        super().__init__()
        self._slider, self._quantity = slider, quantity
        self.marks: tuple[MarkedValue, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        low, high = (quantity.format(value, _DIGITS) for value in quantity.slider)
        self.setAccessibleName(f"From {low} to {high}")

    def show_marks(self, marks: Sequence[MarkedValue]) -> None:
        """Show marks at values within the slider's range."""
        low, high = self._quantity.slider
        inside = tuple(mark for mark in marks if low <= mark.value <= high)
        if inside != self.marks:
            self.marks = inside
            self.setAccessibleDescription(" ".join(self._explain_mark(mark) for mark in inside))
            self.update()

    def _explain_mark(self, mark: MarkedValue) -> str:
        return f"{self._quantity.format(mark.value, 3)}: {mark.meaning}"

    def text_font(self) -> QFont:
        return resize_font(self.font(), _TEXT_SCALE)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a small width, because names of marks are left out if there is no space."""
        return QSize(20, round(QFontMetricsF(self.text_font()).height() + _TICK + 2))

    def x_of(self, value: float) -> float:
        first, last = find_handle_travel(self._slider)
        x = first + self._quantity.fraction(value) * (last - first)
        return x + self._slider.x() - self.x()

    def event(self, event: QEvent) -> bool:
        """Explain a mark when the mouse rests near it."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            near = [
                mark
                for mark in self.marks
                if abs(self.x_of(mark.value) - event.pos().x()) <= _TOOLTIP_DISTANCE
            ]
            if near:
                QToolTip.showText(event.globalPos(), self._explain_mark(near[0]), self)
            else:
                QToolTip.hideText()
            return True
        return super().event(event)

    def paint_with(self, painter: QPainter) -> None:
        font = self.text_font()
        metrics = QFontMetricsF(font)
        painter.setFont(font)
        colour = self.palette().color(QPalette.ColorRole.WindowText)
        ends, names = self.place_texts(metrics)
        painter.setPen(self.palette().color(QPalette.ColorRole.PlaceholderText))
        for text, box in ends:
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
        painter.setPen(QPen(colour, 1.5))
        for mark in self.marks:
            x = self.x_of(mark.value)
            painter.drawLine(QPointF(x, 0.0), QPointF(x, _TICK))
        for text, box in names:
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

    def place_texts(self, metrics: QFontMetricsF) -> tuple[list[_Text], list[_Text]]:
        """Return the end values and the marks' names, each with its place.

        An end value is left out if a mark's name needs its place, because only the name explains
        the mark.
        """
        low, high = self._place_ends(metrics)
        choices: tuple[list[_Text], ...] = ([low, high], [low], [high], [])
        named = [(ends, self._place_names(metrics, [box for _, box in ends])) for ends in choices]
        return max(named, key=lambda texts: len(texts[1]))  # of equal ones, the first

    def _place_names(self, metrics: QFontMetricsF, occupied: Sequence[QRectF]) -> list[_Text]:
        """Return as many of the marks' names as there is space for, with their places.

        A name is centred below its mark, or moved to one side if that leaves more space.
        """
        options: list[list[_Text | None]] = []
        for mark in self.marks:
            text, x = mark.label.replace("t_LED", "1 chip"), self.x_of(mark.value)
            width = metrics.horizontalAdvance(text)
            last_left = max(self.width() - width, 0.0)
            lefts = [x - width * fraction for fraction in (0.5, 0.75, 0.25)]
            lefts += [x - width + _NAME_OVERHANG, x - _NAME_OVERHANG]
            boxes = [
                QRectF(min(max(left, 0.0), last_left), _TICK + 1.0, width, metrics.height())
                for left in lefts
            ]
            options.append([*((text, box) for box in boxes if _is_free(box, occupied)), None])
        best: list[_Text] = []
        for combination in product(*options):
            named = [name for name in combination if name is not None]
            are_apart = all(_is_free(one[1], [other[1]]) for one, other in combinations(named, 2))
            if are_apart and len(named) > len(best):
                best = named
        return best

    def _place_ends(self, metrics: QFontMetricsF) -> tuple[_Text, _Text]:
        low, high = (self._quantity.format(value, _DIGITS) for value in self._quantity.slider)
        height, width = metrics.height(), metrics.horizontalAdvance(high)
        return (
            (low, QRectF(0.0, _TICK + 1.0, metrics.horizontalAdvance(low), height)),
            (high, QRectF(self.width() - width, _TICK + 1.0, width, height)),
        )


def _is_free(box: QRectF, occupied: Sequence[QRectF]) -> bool:
    return not any(box.adjusted(-_GAP, 0, _GAP, 0).intersects(other) for other in occupied)


def find_handle_travel(slider: QSlider) -> tuple[float, float]:
    """Return the x of the handle's centre at both ends, in the slider's own pixels."""
    ends = (_find_handle(slider, position) for position in (slider.minimum(), slider.maximum()))
    first, last = (end.center().x() for end in ends)
    return first, last


def find_handle_sides(slider: QSlider) -> tuple[float, float]:
    """Return the x of the handle's left and right side, in the slider's own pixels."""
    handle = _find_handle(slider, slider.sliderPosition())
    return handle.left(), handle.right()


def _find_handle(slider: QSlider, position: int) -> QRectF:
    option = QStyleOptionSlider()
    slider.initStyleOption(option)
    option.sliderPosition = position
    handle = slider.style().subControlRect(
        QStyle.ComplexControl.CC_Slider, option, QStyle.SubControl.SC_SliderHandle, slider
    )
    return QRectF(handle)
