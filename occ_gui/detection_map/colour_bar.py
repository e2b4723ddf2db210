"""What the colours of a picture stand for."""

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.widgets.guarded_paint import guarded

_BAR = 12
_GAP = 4


class ColourBar(QWidget):
    """An upright bar of colours with numbers beside it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._colours = QImage()
        self._numbers: tuple[tuple[float, str], ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)

    def show_colours(
        self, colours: QImage, numbers: tuple[tuple[float, str], ...], name: str
    ) -> None:
        """Show colours.

        Parameters
        ----------
        colours
            One pixel wide, the upper end first.
        numbers
            Places from 0, below, to 1, and what stands there.
        name
            What it shows, for those who do not see it and as a tooltip.
        """
        self._colours, self._numbers = colours, numbers
        self.setAccessibleName(name)
        self.setToolTip(name)
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """As wide as the bar and its widest number."""
        metrics = self.fontMetrics()
        widest = max((metrics.horizontalAdvance(text) for _, text in self._numbers), default=0)
        return QSize(_BAR + 2 * _GAP + widest, 6 * metrics.height())

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Its height can shrink."""
        return QSize(self.sizeHint().width(), 3 * self.fontMetrics().height())

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the bar and its numbers."""
        painter = QPainter(self)
        line = self.fontMetrics().height()
        bar = QRectF(_GAP, line / 2, _BAR, self.height() - line)
        painter.drawImage(bar, self._colours)
        painter.setPen(self.palette().color(QPalette.ColorRole.Mid))
        painter.drawRect(bar)
        painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
        room = max(2, int(self.height() / (1.4 * line)))
        step = 1 if len(self._numbers) <= room else len(self._numbers) - 1
        for place, text in self._numbers[::step]:
            middle = bar.bottom() - place * bar.height()
            spot = QRectF(bar.right() + _GAP, middle - line / 2, self.width(), line)
            painter.drawText(spot, Qt.AlignmentFlag.AlignVCenter, text)
