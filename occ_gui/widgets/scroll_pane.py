"""Scroll pane: scrolls vertically where its content is higher."""

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QWidget


class ScrollPane(QScrollArea):
    """Shows a widget as wide as the pane, and as high as it needs.

    Parameters
    ----------
    content
        The content.
    least
        The least size in pixels.
    parent
        The parent widget.
    """

    def __init__(self, content: QWidget, least: QSize, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._least = least
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWidget(content)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the least size, or the smaller height of the content."""
        content = self.widget()
        least = self._least if content is None else content.minimumSizeHint()
        return QSize(self._least.width(), min(self._least.height(), least.height()))
