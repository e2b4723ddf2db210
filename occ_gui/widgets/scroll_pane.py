"""Scroll pane: scrolls vertically if its content is higher."""

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QTabWidget, QWidget


class ScrollPane(QScrollArea):
    """Shows a widget that is as wide as the pane, and as high as it needs to be."""

    def __init__(self, content: QWidget, least: QSize) -> None:
        super().__init__()
        self._least = least
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWidget(content)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        handled = super().eventFilter(watched, event)
        if event.type() == QEvent.Type.LayoutRequest and watched is self.widget():
            self.updateGeometry()
        return handled

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the least size, no narrower than the content, which only scrolls vertically."""
        content = self.widget()
        if content is None:
            return self._least
        least, bar = content.minimumSizeHint(), self.verticalScrollBar().sizeHint().width()
        width = max(self._least.width(), least.width() + bar)
        return QSize(width, min(self._least.height(), least.height()))


def bring_into_view(widget: QWidget, margin: int = 50) -> None:
    """Select the tabs and scroll the areas that contain a widget, so that it is visible."""
    scrolled: list[QScrollArea] = []
    page, around = widget, widget.parentWidget()
    while around is not None:
        tabs = around.parentWidget()
        if isinstance(around, QScrollArea):
            scrolled.append(around)
        elif isinstance(tabs, QTabWidget):
            tabs.setCurrentWidget(page)
        page, around = around, tabs
    for area in scrolled:  # only now, when a page that was never in front has been laid out
        area.ensureWidgetVisible(widget, 0, margin)
