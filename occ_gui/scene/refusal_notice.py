"""Refusal notice: the reason why a value was refused, below the field."""

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import (
    QAccessible,
    QAccessibleEvent,
    QColor,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
)
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QApplication,
    QDockWidget,
    QLabel,
    QScrollArea,
    QWidget,
)

from occ_gui.widgets.colours import lighten_for
from occ_gui.widgets.frame_over import FrameOver
from occ_gui.widgets.guarded_paint import guarded

_RED = QColor("#b3261e")

_PADDING, _MARGIN, _GAP = 6, 4, 2
"""Pixels around the sentence, beside it, and between it and the field."""


class RefusalNotice(QLabel):
    """A sentence below a field that says what is wrong; hidden if nothing is.

    It covers what is below the field, so that nothing moves when it appears. It is hidden by the
    next key, a click on it, another sentence of the window, and when the focus moves on. If the
    field still shows what is wrong, the field has a frame, and the sentence is shown again when
    the field gets the focus. Screen readers announce it, and read it as the field's description.
    """

    dismissed = Signal()  # the user has removed the sentence by a click or Escape

    def __init__(self, field: QWidget) -> None:
        super().__init__(field)
        self._field = field
        self._frame = FrameOver(
            field, field, field.rect, lambda colours: lighten_for(colours, _RED)
        )
        self._frame.hide()
        self._stays = self._is_watching = False
        self.setWordWrap(True)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setContentsMargins(_PADDING, _PADDING, _PADDING, _PADDING)
        self.hide()
        field.installEventFilter(self)

    def show_problem(self, sentence: str, *, stays: bool = True) -> None:
        """Show what is wrong; ``stays``: whether the field still shows what is wrong."""
        self._stays = stays
        self.setText(sentence)
        self._field.setAccessibleDescription(sentence)
        self._update_colour()
        self._frame.setVisible(stays)
        self._show_on_page()
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))

    def show_refusal(self, sentence: str) -> None:
        """Show why an input was refused; the field shows the last value again."""
        self.show_problem(sentence, stays=False)

    def _show_on_page(self) -> None:
        """Show the sentence on top of the field's page, in place of any other of the window."""
        page = _find_page(self._field)
        if self.parentWidget() is not page:
            self.setParent(page)
            page.installEventFilter(self)
        for other in page.window().findChildren(RefusalNotice):
            if other is not self and other.isVisible():
                other._withdraw()
        self._place()
        self.show()
        self.raise_()
        # Not at once: the key or the move of the focus that ended the input is still on its way.
        QTimer.singleShot(0, self, self._watch)

    def _watch(self) -> None:
        application = QApplication.instance()
        if application is None or self._is_watching or self.isHidden():
            return
        self._is_watching = True
        if (area := _find_area(self)) is not None:
            area.ensureWidgetVisible(self, 0, _MARGIN)
        application.installEventFilter(self)

    def _withdraw(self) -> None:
        """Hide the sentence; forget it unless the field still shows what is wrong."""
        if self._is_watching and (application := QApplication.instance()) is not None:
            application.removeEventFilter(self)
        self._is_watching = False
        self.hide()
        if not self._stays:
            self.end()

    def _place(self) -> None:
        """Place the sentence below the field, or above it if there is no room below."""
        page = self.parentWidget() or self._field
        width = page.width() - 2 * _MARGIN
        height = self.heightForWidth(width)
        top = self._field.mapTo(page, self._field.rect().bottomLeft()).y() + _GAP
        if top + height > page.height():
            above = self._field.mapTo(page, self._field.rect().topLeft()).y() - _GAP - height
            top = above if above >= 0 else max(0, page.height() - height)
        self.setGeometry(_MARGIN, top, width, height)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        kind = event.type()
        if self._is_watching and kind in {QEvent.Type.KeyPress, QEvent.Type.FocusIn}:
            self._withdraw()
            if isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape:
                self.end()
                self.dismissed.emit()
        elif self.text() and watched is self._field and kind == QEvent.Type.FocusIn:
            self._show_on_page()
        elif (
            self.isVisible()
            and kind in {QEvent.Type.Resize, QEvent.Type.Move}
            and watched in (self._field, self.parentWidget())
        ):
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
            self._stays = True
            self.clear()
            self._field.setAccessibleDescription("")
            self._frame.hide()
            self._withdraw()

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


def _find_area(notice: QWidget) -> QScrollArea | None:
    """Return the area with which a notice scrolls."""
    parent = notice.parentWidget()
    while parent is not None and not isinstance(parent, QScrollArea):
        parent = parent.parentWidget()
    return parent


def _find_page(field: QWidget) -> QWidget:
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
