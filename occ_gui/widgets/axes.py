"""A linear and a logarithmic axis for plots; an exception while drawing them is only reported."""

import math
from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QGraphicsSceneResizeEvent, QStyleOptionGraphicsItem, QWidget

from occ_gui.widgets.columns import round_step
from occ_gui.widgets.guarded_paint import guarded

NUMBER_LENGTH = {"left": 18.0, "bottom": 36.0}  # pixels that a number takes along the axis

_LEAST_SPACING = 3.0  # least distance in pixels between unnumbered ticks at powers of ten

_LEAST_NUMBERS = 2  # with fewer powers of ten in view, other round values have numbers, too

_LARGEST_POWER = 300  # powers of ten with a larger exponent, of either sign, are written as 1e+N


class Axis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph has no types
    """A linear axis, which stays empty if no numbers can be found for its range."""

    def __init__(self, side: str) -> None:
        super().__init__(side)
        # pyqtgraph would write values below 1 in thousandths: 800 and "light (x0.001)".
        self.enableAutoSIPrefix(False)

    @guarded
    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None
    ) -> None:
        super().paint(painter, option, widget)

    def resizeEvent(  # noqa: N802 - Qt's name
        self, event: QGraphicsSceneResizeEvent | None = None
    ) -> None:
        self._fit_name()
        super().resizeEvent(event)

    def _updateLabel(self) -> None:  # noqa: N802 - pyqtgraph's name
        super()._updateLabel()
        self.resizeEvent()

    def _fit_name(self) -> None:
        """Leave out the first words of a name that is too long: its symbol and unit are the last.

        The tooltip shows the whole name.
        """
        label, name = self.label, self.labelText
        if label is None or not name:  # None once the plot is closed
            return
        is_upright = self.orientation in {"left", "right"}
        # The name may extend beyond both ends of the axis by the same distance.
        place = self.scenePos()
        room = self.height() + 2.0 * place.y() if is_upright else self.width()
        whole = self.labelString()
        words = name.split(" ")
        for first in range(len(words) + 1):
            shown = name if first == 0 else " ".join(["…", *words[first:]])
            label.setHtml(whole.replace(name, shown if words[first:] else "", 1))
            label.setToolTip(name if first else "")
            if label.boundingRect().width() <= room or room <= 0.0:
                return

    def generateDrawSpecs(  # noqa: N802 - pyqtgraph's name
        self, painter: QPainter
    ) -> tuple[Any, Any, list[tuple[QRectF, Any, str]]] | None:
        """Lay out the axis with numbers at integer pixels, which all versions of Qt draw alike."""
        specs = super().generateDrawSpecs(painter)
        if specs is None:
            return None
        line, ticks, numbers = specs
        return line, ticks, [(QRectF(box.toRect()), *rest) for box, *rest in numbers]


class LogAxis(Axis):
    """An axis for decimal logarithms, labelled with the values themselves.

    ``least``: the exponent at which smaller values are drawn, too; its label begins with ≤.
    """

    def __init__(self, side: str, least: int | None = None) -> None:
        super().__init__(side)
        self._number_length = NUMBER_LENGTH[side]
        self._least = least

    def tickValues(  # noqa: N802 - pyqtgraph's name
        self, low: float, high: float, size: float
    ) -> list[tuple[float, list[float]]]:
        decades_a_pixel = (high - low) / max(size, 1.0)
        step = max(1, math.ceil(self._number_length * decades_a_pixel))
        edge = 0.4 * self._number_length * decades_a_pixel
        numbered = [
            float(power) for power in self._list_powers(low, high, step)
            if low + edge <= power <= high - edge
        ]  # fmt: skip
        is_short = len(numbered) < _LEAST_NUMBERS and self._least not in numbered
        if is_short and abs(high) <= _LARGEST_POWER:
            numbered = self._round_values(low + edge, high - edge, decades_a_pixel)
        # Limited by the pixels, because a view can show any number of decades.
        powers = self._list_powers(low, high, max(1, math.ceil(_LEAST_SPACING * decades_a_pixel)))
        digits = range(1, 10) if step == 1 else (1,)
        ticks = [power + math.log10(digit) for power in powers for digit in digits]
        unnumbered = [tick for tick in ticks if low <= tick <= high and tick not in numbered]
        return [(1.0, numbered), (0.1, unnumbered)]

    def _round_values(self, low: float, high: float, decades_a_pixel: float) -> list[float]:
        """Return evenly spaced round values, with room for a number where they are densest."""
        largest = 10.0**high
        step = round_step(largest * (1.0 - 10.0 ** (-self._number_length * decades_a_pixel)))
        first, last = math.ceil(10.0**low / step), math.floor(largest / step)
        return [math.log10(place * step) for place in range(max(first, 1), last + 1)]

    def _list_powers(self, low: float, high: float, step: int) -> range:
        """Return every ``step``-th exponent in an interval, counted from the least exponent."""
        first = math.floor(low)
        return range(first + ((self._least or 0) - first) % step, math.ceil(high) + 1, step)

    def tickStrings(  # noqa: N802 - pyqtgraph's name
        self, values: list[float], _scale: float, spacing: float
    ) -> list[str]:
        if spacing < 1.0:
            return [""] * len(values)
        signs = ["≤ " if value == self._least else "" for value in values]
        return [f"{sign}{_format_power(value)}" for sign, value in zip(signs, values, strict=True)]


def _format_power(exponent: float) -> str:
    if abs(exponent) > _LARGEST_POWER:
        return f"1e{exponent:+g}"
    return f"{10.0**exponent:g}"
