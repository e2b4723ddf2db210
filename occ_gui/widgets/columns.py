"""Shared parts of axes over columns: key steps, tick steps, and the first range in view."""

import math

from PySide6.QtCore import Qt

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
PACKETS_IN_VIEW = 2  # packets in the first view of a plot over columns


def round_step(least: float) -> float:
    """Return the smallest number of at least this size that is 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(least))
    steps = (factor * power for factor in (1.0, 2.0, 5.0, 10.0))
    return next(step for step in steps if step >= least * (1.0 - _STEP_TOLERANCE))


def first_periods(sent: Transmitter) -> tuple[str, str]:
    """Return the text and the tip of a button that shows the first periods of a light."""
    sender, periods = "light", "periods"
    if has_chips(sent):
        sender, periods = ("pattern", "cycles") if sent.pattern else ("panel", "packets")
    tip = f"Show the first {periods} of the {sender}, and follow them."
    return f"{PACKETS_IN_VIEW} {periods}", tip
