"""What a window says: labels, fields, lists, tables, plots, and what a screen reader hears."""

from collections.abc import Iterator

import pyqtgraph as pg
from PySide6.QtWidgets import QGraphicsTextItem, QGraphicsView, QTableView, QTextEdit, QWidget


def visible_texts(window: QWidget) -> Iterator[str]:
    yield window.windowTitle()
    for widget in (window, *window.findChildren(QWidget)):
        if not widget.isVisible():
            continue
        for name in ("text", "title", "currentText", "accessibleDescription"):
            get = getattr(widget, name, None)
            if callable(get) and not isinstance(widget, QTextEdit):
                yield str(get())
        match widget:
            case QTextEdit():
                yield widget.toPlainText()
            case QTableView():
                model = widget.model()
                for row in range(model.rowCount()):
                    for column in range(model.columnCount()):
                        yield str(model.index(row, column).data() or "")
            case QGraphicsView():
                yield from _drawn_texts(widget)


def _drawn_texts(view: QGraphicsView) -> Iterator[str]:
    for item in view.items():
        if not item.isVisible():
            continue
        if isinstance(item, QGraphicsTextItem):
            yield item.toPlainText()
        elif isinstance(item, pg.AxisItem):
            yield item.labelText
