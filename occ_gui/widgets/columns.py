"""Common to axes over columns, without a plot: steps, and the periods first in view."""

import math

from PySide6.QtCore import Qt

KEY_STEPS = {
    Qt.Key.Key_Left: -1,
    Qt.Key.Key_Right: 1,
    Qt.Key.Key_PageDown: -10,
    Qt.Key.Key_PageUp: 10,
}
"""Keys that choose another column, and how many columns further to the right it lies."""

_STEP_TOLERANCE = 1e-9  # by how much, of its size, a step may be smaller than requested
PACKETS_IN_VIEW = 2  # packets in the first view of a plot over columns


def round_step(least: float) -> float:
    """Return the smallest of 1, 2 and 5 times a power of ten that is not below a number."""
    power = 10.0 ** math.floor(math.log10(least))
    steps = (factor * power for factor in (1.0, 2.0, 5.0, 10.0))
    return next(step for step in steps if step >= least * (1.0 - _STEP_TOLERANCE))


def first_periods(has_packets: bool) -> tuple[str, str]:
    whose, periods = ("panel", "packets") if has_packets else ("pattern", "cycles")
    tip = f"Show the {whose}'s first {periods}, and follow them."
    return f"{PACKETS_IN_VIEW} {periods}", tip
