"""Refusal notice: why a value was refused, under its field, and a frame round the field."""

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import (
    QAccessible,
    QAccessibleEvent,
    QColor,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
)
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from occ_gui.scene.wording import refusal_of, with_labels
from occ_gui.widgets.contrast import seen_on
from occ_gui.widgets.guarded_paint import guarded

_RED = QColor("#b3261e")

_FRAME_WIDTH = 2


class RefusalNotice(QLabel):
    """A sentence under a field that says what is wrong; hidden until there is one.

    Screen readers announce it, and read it as the description of the field.

    Parameters
    ----------
    field
        The field, which a frame is drawn round while there is a sentence.
    parent
        The parent widget.
    """

    def __init__(self, field: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._field = field
        self._frame = _Frame(field)
        self.setWordWrap(True)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.hide()

    def show_refusal(self, sentence: str) -> None:
        """Show why a value was refused; the field shows the last one."""
        self._show(refusal_of(sentence))

    def show_problem(self, sentence: str) -> None:
        """Show what is wrong with the value that the field shows."""
        self._show(with_labels(sentence))

    def _show(self, sentence: str) -> None:
        self.setText(sentence)
        self._field.setAccessibleDescription(sentence)
        self._take_colour()
        self._frame.show()
        self.show()
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))

    def end(self) -> None:
        """Remove the sentence: the value is mended, or no longer wanted."""
        if self.text():
            self.clear()
            self._field.setAccessibleDescription("")
            self._frame.hide()
            self.hide()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Follow the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self.text():
            self._take_colour()

    def _take_colour(self) -> None:
        paper = QApplication.palette()
        paper.setColor(QPalette.ColorRole.Base, paper.color(self.backgroundRole()))
        ink = seen_on(paper, _RED)
        if self.palette().color(self.foregroundRole()) != ink:
            colours = QPalette()  # in which all other colours stay those of the theme
            colours.setColor(self.foregroundRole(), ink)
            self.setPalette(colours)


class _Frame(QWidget):
    """A frame drawn over the edge of a field, whatever the style of the field."""

    def __init__(self, field: QWidget) -> None:
        super().__init__(field)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.hide()
        field.installEventFilter(self)
        self.setGeometry(field.rect())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Follow the size of the field."""
        if event.type() == QEvent.Type.Resize and isinstance(watched, QWidget):
            self.setGeometry(watched.rect())
        return False

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the frame."""
        painter = QPainter(self)
        painter.setPen(QPen(seen_on(self.palette(), _RED), _FRAME_WIDTH))
        half = _FRAME_WIDTH // 2
        painter.drawRect(self.rect().adjusted(half, half, -half, -half))
