"""Axes: one whose drawing cannot fail, and one over logarithms with numbers at powers of ten."""

import math

import pyqtgraph as pg
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QStyleOptionGraphicsItem, QWidget

from occ_gui.widgets.guarded_paint import guarded

_ROOM = {"left": 18.0, "bottom": 36.0}
"""Pixels that a number needs along the axis."""

_APART = 3.0
"""Pixels between two ticks without a number, at least, where they stand at powers of ten."""

_LARGEST_POWER = 300
"""A larger power of ten is not written out, nor is a smaller one than one over it."""


class Axis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph has no types
    """An axis that stays empty where its range cannot be numbered."""

    @guarded
    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None
    ) -> None:
        """Draw the axis, its ticks and its numbers."""
        super().paint(painter, option, widget)


class LogAxis(Axis):
    """An axis of decimal logarithms that shows what they are the logarithms of.

    Parameters
    ----------
    side
        Where it stands, ``"left"`` or ``"bottom"``.
    least
        The power of ten at which all that is smaller is shown, too, if there is any.
    """

    def __init__(self, side: str, least: int | None = None) -> None:
        super().__init__(side)
        self._room = _ROOM[side]
        self._least = least

    def tickValues(  # noqa: N802 - pyqtgraph's name
        self, low: float, high: float, size: float
    ) -> list[tuple[float, list[float]]]:
        """Give powers of ten whose numbers are not cut off nor too close, and what lies between."""
        decades_a_pixel = (high - low) / max(size, 1.0)
        step = max(1, math.ceil(self._room * decades_a_pixel))
        edge = 0.4 * self._room * decades_a_pixel
        numbered = [
            float(power) for power in self._powers(low, high, step)
            if low + edge <= power <= high - edge
        ]  # fmt: skip
        # As many as there are pixels for: a view can be zoomed to any number of decades.
        powers = self._powers(low, high, max(1, math.ceil(_APART * decades_a_pixel)))
        digits = range(1, 10) if step == 1 else (1,)
        ticks = [power + math.log10(digit) for power in powers for digit in digits]
        between = [tick for tick in ticks if low <= tick <= high and tick not in numbered]
        return [(1.0, numbered), (0.1, between)]

    def _powers(self, low: float, high: float, step: int) -> range:
        """Give every so many powers of ten round an interval, counted from the least one."""
        first = math.floor(low)
        return range(first + ((self._least or 0) - first) % step, math.ceil(high) + 1, step)

    def tickStrings(  # noqa: N802 - pyqtgraph's name
        self, values: list[float], _scale: float, spacing: float
    ) -> list[str]:
        """Write the powers of ten out."""
        if spacing < 1.0:
            return [""] * len(values)
        signs = ["≤ " if value == self._least else "" for value in values]
        return [f"{sign}{_power(value)}" for sign, value in zip(signs, values, strict=True)]


def _power(exponent: float) -> str:
    if abs(exponent) > _LARGEST_POWER:
        return f"1e{exponent:+g}"
    return f"{10.0**exponent:g}"
