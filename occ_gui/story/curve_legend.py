"""Legend of the profile's curves, painted in a line that may be narrow."""

from collections.abc import Mapping

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.widgets.contrast import pen_on
from occ_gui.widgets.guarded_paint import guarded

_SAMPLE, _GAP, _APART = 24, 6, 16


class CurveLegend(QWidget):
    """Samples of lines with their names; those that do not fit are left out at the end.

    Parameters
    ----------
    lines
        Each line's pen and name, by its key.
    parent
        The parent widget.
    """

    def __init__(
        self, lines: Mapping[str, tuple[QPen, str]], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._lines = dict(lines)
        self.shown: tuple[str, ...] = ()
        self.note = ""
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.tr("Curves of the profile"))

    def rename(self, key: str, name: str) -> None:
        """Give a line another name."""
        pen, before = self._lines[key]
        if name != before:
            self._lines[key] = (pen, name)
            keys, note = self.shown, self.note
            self.shown = ()
            self.show_lines(keys, note, self.toolTip())

    def show_lines(self, keys: tuple[str, ...], note: str = "", meaning: str = "") -> None:
        """Show these entries, and a remark after them; the pointer gets a sentence to read."""
        self.setToolTip(meaning)
        if (keys, note) != (self.shown, self.note):
            self.shown, self.note = keys, note
            texts = [self._lines[key][1] for key in keys] + ([note] if note else [])
            self.setAccessibleDescription(", ".join(texts))
            self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the height of a line of text."""
        return QSize(120, self.fontMetrics().height() + 2)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size of the first sample."""
        return QSize(_SAMPLE, self.sizeHint().height())

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the entries that fit."""
        painter = QPainter(self)
        metrics, text = painter.fontMetrics(), self.palette().color(QPalette.ColorRole.WindowText)
        left, middle = 0.0, self.height() / 2
        for key in self.shown:
            pen, name = self._lines[key]
            width = _SAMPLE + _GAP + metrics.horizontalAdvance(name)
            if left + width > self.width():
                return
            thick = QPen(pen_on(self.palette(), pen))
            thick.setWidth(2)
            painter.setPen(thick)
            painter.drawLine(QPointF(left, middle), QPointF(left + _SAMPLE, middle))
            painter.setPen(text)
            place = QRectF(left + _SAMPLE + _GAP, 0, width, self.height())
            painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, name)
            left += width + _APART
        if self.note and left + metrics.horizontalAdvance(self.note) <= self.width():
            place = QRectF(left, 0, self.width() - left, self.height())
            painter.setPen(text)
            painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, self.note)
        painter.end()
