"""Shared parts of plots over columns: key steps, tick steps, and the first ranges in view."""

import math

from PySide6.QtCore import Qt

from occ_model.arrays import LARGEST_BYTE
from occ_model.scene.light_words import has_chips
from occ_model.scene.scene import Transmitter

KEY_STEPS = {
    Qt.Key.Key_Left: -1,
    Qt.Key.Key_Right: 1,
    Qt.Key.Key_PageDown: -10,
    Qt.Key.Key_PageUp: 10,
}
"""Keys that move to another column, and the number of columns to the right."""

_STEP_TOLERANCE = 1e-9  # relative amount by which a step may fall short of the least
_LEVEL_STEP = 20.0  # the end of an axis of grey levels is a multiple of it, or the largest level
PACKETS_IN_VIEW = 2  # packets in the first view of a plot over columns


def round_step(least: float) -> float:
    """Return the smallest number of at least this size that is 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(least))
    steps = (factor * power for factor in (1.0, 2.0, 5.0, 10.0))
    return next(step for step in steps if step >= least * (1.0 - _STEP_TOLERANCE))


def round_level_up(largest: float) -> float:
    """Return the end of an axis of grey levels, in wide steps so that it rarely changes."""
    return min(max(_LEVEL_STEP, math.ceil(largest / _LEVEL_STEP) * _LEVEL_STEP), LARGEST_BYTE)


def first_periods(sent: Transmitter) -> tuple[str, str]:
    """Return the text and the tip of a button that shows the first periods of a light."""
    sender, periods = "light", "periods"
    if has_chips(sent):
        sender, periods = ("pattern", "cycles") if sent.pattern else ("panel", "packets")
    tip = f"Show the first {periods} of the {sender}, and follow them."
    return f"{PACKETS_IN_VIEW} {periods}", tip
