"""Refusal notice: the reason why a value was refused, below the field, which gets a frame."""

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, Signal
from PySide6.QtGui import (
    QAccessible,
    QAccessibleEvent,
    QColor,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
)
from PySide6.QtWidgets import QAbstractScrollArea, QApplication, QDockWidget, QLabel, QWidget

from occ_gui.widgets.colours import lighten_for
from occ_gui.widgets.frame_over import FrameOver
from occ_gui.widgets.guarded_paint import guarded

_RED = QColor("#b3261e")

_PADDING, _MARGIN, _GAP = 6, 4, 2
"""Pixels around the sentence, beside it, and between it and the field."""


class RefusalNotice(QLabel):
    """A sentence below a field that says what is wrong; hidden if nothing is.

    It covers what is below the field, so that nothing moves when it appears; a click removes it.
    Screen readers announce it, and read it as the description of the field.
    """

    dismissed = Signal()  # the user has clicked the sentence away

    def __init__(self, field: QWidget) -> None:
        super().__init__(field)
        self._field = field
        self._frame = FrameOver(
            field, field, field.rect, lambda colours: lighten_for(colours, _RED)
        )
        self._frame.hide()
        self.setWordWrap(True)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setContentsMargins(_PADDING, _PADDING, _PADDING, _PADDING)
        self.hide()
        field.installEventFilter(self)

    def show_problem(self, sentence: str) -> None:
        self.setText(sentence)
        self._field.setAccessibleDescription(sentence)
        self._update_colour()
        self._frame.show()
        self._show_on_page()
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))

    def _show_on_page(self) -> None:
        """Show the sentence on top of the field's page."""
        page = _page_of(self._field)
        if self.parentWidget() is not page:
            self.setParent(page)
            page.installEventFilter(self)
        self._place()
        self.show()
        self.raise_()

    def _place(self) -> None:
        """Place the sentence below the field, or above it if there is no room below."""
        page = self.parentWidget() or self._field
        width = page.width() - 2 * _MARGIN
        height = self.heightForWidth(width)
        top = self._field.mapTo(page, self._field.rect().bottomLeft()).y() + _GAP
        if top + height > page.height():
            above = self._field.mapTo(page, self._field.rect().topLeft()).y() - _GAP - height
            top = above if above >= 0 else top
        self.setGeometry(_MARGIN, top, width, height)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if self.text() and self.parentWidget() is not self._field:
            if watched is self._field and event.type() in {QEvent.Type.Hide, QEvent.Type.Show}:
                self.setVisible(event.type() == QEvent.Type.Show)
            if event.type() in {QEvent.Type.Resize, QEvent.Type.Move, QEvent.Type.Show}:
                self._place()
        return super().eventFilter(watched, event)

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        self.end()
        self.dismissed.emit()
        event.accept()

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(self.palette().color(self.foregroundRole()))
        painter.setBrush(self.palette().color(QPalette.ColorRole.Window))
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
        painter.end()
        super().paintEvent(event)

    def end(self) -> None:
        """Remove the sentence, because the value was corrected or the input abandoned."""
        if self.text():
            self.clear()
            self._field.setAccessibleDescription("")
            self._frame.hide()
            self.hide()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self.text():
            self._update_colour()

    def _update_colour(self) -> None:
        theme = QApplication.palette()
        theme.setColor(QPalette.ColorRole.Base, theme.color(self.backgroundRole()))
        red = lighten_for(theme, _RED)
        if self.palette().color(self.foregroundRole()) != red:
            colours = QPalette()  # all other colours stay the theme's
            colours.setColor(self.foregroundRole(), red)
            self.setPalette(colours)


def _page_of(field: QWidget) -> QWidget:
    """Return the page with which a field scrolls, or else its pane or window."""
    page = field
    while not page.isWindow() and (parent := page.parentWidget()) is not None:
        pane = parent.parentWidget()
        if isinstance(parent, QDockWidget) or (
            isinstance(pane, QAbstractScrollArea) and pane.viewport() is parent
        ):
            return page if page is not field else parent
        page = parent
    return page
