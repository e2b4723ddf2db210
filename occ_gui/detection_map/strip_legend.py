"""Legend of the strips: what the colours on the sliders' tracks mean."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.detection_map.colour_map import RATES, image_of, to_colours
from occ_gui.widgets.guarded_paint import guarded

_BAR = QSize(56, 6)
_GAP = 6


class StripLegend(QWidget):
    """A bar from "no bit read" to "all bits read", in a line; in a low window it is left out."""

    def __init__(self) -> None:
        super().__init__()
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self.setAccessibleName("Colours of the sliders")
        meaning = (
            "What the decoder shown would read if this slider alone were moved: the colours go "
            "from no bit read correctly to all bits read correctly."
        )
        self.setAccessibleDescription(meaning)
        self.setToolTip(meaning)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(120, self.fontMetrics().height() + 2)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return no height: the sliders come first."""
        return QSize(120, 0)

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the bar between its two words, if the line is whole."""
        if self.height() < self.fontMetrics().height():
            return
        painter = QPainter(self)
        painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
        left = 0.0
        middle = self.height() / 2
        parts = ("misread", None, "read")
        for text in parts:
            if text is None:
                shares = np.linspace(0.0, 1.0, _BAR.width())[:, None]
                place = QRectF(QPointF(left, middle - _BAR.height() / 2), _BAR.toSizeF())
                painter.drawImage(place, image_of(to_colours(shares, 0.0, 1.0, RATES)))
                left += _BAR.width() + _GAP
                continue
            width = self.fontMetrics().horizontalAdvance(text)
            place = QRectF(left, 0, width + 1, self.height())
            painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, text)
            left += width + _GAP
        painter.end()
