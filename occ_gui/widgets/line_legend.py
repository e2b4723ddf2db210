"""A legend outside the plot, where no curve runs through it."""

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QPainter, QPen, QPixmap
from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

_SAMPLE = QSize(24, 12)


class LineLegend(QWidget):
    """Samples of lines with their names, in a row."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._entries: dict[str, QWidget] = {}
        self._samples: dict[str, QLabel] = {}

    def add_line(self, key: str, pen: QPen, text: str) -> None:
        """Add an entry, shown until :meth:`show_line` hides it."""
        self.add_sample(key, _sample(pen), text)

    def add_sample(self, key: str, picture: QPixmap, text: str, meaning: str = "") -> None:
        """Add an entry for what is drawn as in a picture; what it means is its tooltip."""
        sample, name = QLabel(), QLabel(text)
        sample.setPixmap(picture)
        entry = QWidget()
        entry.setToolTip(meaning)
        layout = QHBoxLayout(entry)
        layout.setContentsMargins(0, 0, 6, 0)
        layout.addWidget(sample)
        layout.addWidget(name)
        self._row.addWidget(entry)
        self._entries[key] = entry
        self._samples[key] = sample

    def set_sample(self, key: str, picture: QPixmap) -> None:
        """Draw an entry's sample in another way, as when the theme changes."""
        self._samples[key].setPixmap(picture)

    def show_line(self, key: str, visible: bool) -> None:
        """Show or hide an entry."""
        self._entries[key].setVisible(visible)


def _sample(pen: QPen) -> QPixmap:
    pixmap = QPixmap(_SAMPLE)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    thick = QPen(pen)
    thick.setWidth(max(2, pen.width()))
    painter.setPen(thick)
    painter.drawLine(0, _SAMPLE.height() // 2, _SAMPLE.width(), _SAMPLE.height() // 2)
    painter.end()
    return pixmap
