"""Room for text in the rows of the story: as much as usual, and more for larger text."""

from collections.abc import Sequence

from PySide6.QtGui import QFont, QFontMetrics

from occ_gui.story.column_axis import GUTTER

_WIDEST_WORD = "chips"  # the widest of the words beside a row's name
GAPS = 14  # pixels between and around a name and what stands beside it
_WIDEST = 2 * GUTTER  # more would leave the columns too little room


def line_height(metrics: QFontMetrics, usual: int, around: int = 2) -> int:
    """Return the height of a line of text in pixels, with so many above and below it."""
    return max(usual, metrics.height() + around)


def gutter_of(font: QFont, names: Sequence[str]) -> int:
    """Return the width in pixels that the names of the rows need, with what stands beside them."""
    widest = max(needed_by(name, font) for name in names)
    return min(max(GUTTER, widest + GAPS), _WIDEST)


def needed_by(name: str, font: QFont) -> int:
    """Return the width in pixels of a row's name and what stands beside it, without gaps."""
    bold = QFont(font)
    bold.setBold(True)
    beside = QFontMetrics(font).horizontalAdvance(_WIDEST_WORD)
    return QFontMetrics(bold).horizontalAdvance(name) + beside
