"""An axis over logarithms, numbered at whole powers of ten."""

import math

import pyqtgraph as pg

_ROOM = {"left": 18.0, "bottom": 36.0}
"""Pixels that a number needs along the axis."""


class LogAxis(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph has no types
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
        decades = range(math.floor(low), math.ceil(high) + 1)
        step = max(1, math.ceil(self._room * (high - low) / max(size, 1.0)))
        edge = 0.4 * self._room * (high - low) / max(size, 1.0)
        numbered = [
            float(power)
            for power in decades
            if (power - (self._least or 0)) % step == 0 and low + edge <= power <= high - edge
        ]
        digits = range(1, 10) if step == 1 else (1,)
        ticks = [power + math.log10(digit) for power in decades for digit in digits]
        between = [tick for tick in ticks if low <= tick <= high and tick not in numbered]
        return [(1.0, numbered), (0.1, between)]

    def tickStrings(  # noqa: N802 - pyqtgraph's name
        self, values: list[float], _scale: float, spacing: float
    ) -> list[str]:
        """Write the powers of ten out."""
        if spacing < 1.0:
            return [""] * len(values)
        signs = ["≤ " if value == self._least else "" for value in values]
        return [f"{sign}{10.0**value:g}" for sign, value in zip(signs, values, strict=True)]
