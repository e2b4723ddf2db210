"""Mark of an outdated result: it dims the pane and shows the reason."""

import math

from PySide6.QtCore import QEvent, QObject, QRectF, Qt, QTimer
from PySide6.QtGui import QPainter, QPalette
from PySide6.QtWidgets import QApplication, QWidget

from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_gui.widgets.state_look import is_dark

DELAY = 0.12  # seconds; a pane that is outdated for less is not marked, so that it does not flicker
_FRESH_AGE = DELAY / 3  # a mark that is shown stays until a result is at most this old

_OPACITY = {False: 0.45, True: 0.3}
"""Opacity of the dimming in light and in dark colours, of which less would remain visible."""

_PADDING = 8


class OutdatedMark(PaintedWidget):
    """Dims a pane while its result belongs to an earlier scene, and shows the reason."""

    def __init__(self, pane: QWidget) -> None:
        super().__init__(pane)
        self._pane = pane
        self.text = ""
        self.setFont(QApplication.font())  # not the smaller one that a table may have
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.hide()
        self._delay_timer = QTimer(self, singleShot=True)
        self._delay_timer.timeout.connect(self._appear)
        pane.installEventFilter(self)

    def show_age(self, age: float, text: str) -> None:
        """Mark the pane once its result has been outdated for a moment.

        ``age``: for how many seconds it has been outdated; 0 if it is not.
        """
        if age == 0.0 and self.isHidden() and not self._delay_timer.isActive():
            return
        self._set_text(text)
        if age == 0.0 or (self.isHidden() and age < DELAY) or age < _FRESH_AGE:
            self.hide()
        if age == 0.0:
            self._delay_timer.stop()
        elif age >= DELAY:
            self._appear()
        else:
            self._delay_timer.start(math.ceil(1e3 * (DELAY - age)))

    def _set_text(self, text: str) -> None:
        if text != self.text:
            self.text = text
            self.setAccessibleName(text)
            self.update()

    def _appear(self) -> None:
        self._delay_timer.stop()
        if self.isHidden():
            self.setGeometry(self._pane.rect())
            self.show()
            self.raise_()

    def _is_within_another(self) -> bool:
        """Return whether a pane around this one is marked."""
        directly = Qt.FindChildOption.FindDirectChildrenOnly
        pane = self._pane.parentWidget()
        while pane is not None:
            marks = pane.findChildren(OutdatedMark, options=directly)
            if any(mark.isVisible() for mark in marks):
                return True
            pane = pane.parentWidget()
        return False

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._pane.rect())
        return super().eventFilter(watched, event)

    def paint_with(self, painter: QPainter) -> None:
        if self._is_within_another():
            return  # which dims this pane, too
        palette = self.palette()
        painter.setOpacity(_OPACITY[is_dark(palette)])
        painter.fillRect(self.rect(), palette.color(QPalette.ColorRole.Window))
        painter.setOpacity(1.0)
        metrics = self.fontMetrics()
        text = metrics.elidedText(
            self.text, Qt.TextElideMode.ElideRight, self.width() - 4 * _PADDING
        )
        width = metrics.horizontalAdvance(text) + 2 * _PADDING
        plate = QRectF((self.width() - width) / 2, _PADDING, width, metrics.height() + _PADDING)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(palette.color(QPalette.ColorRole.Mid))
        painter.setBrush(palette.color(QPalette.ColorRole.ToolTipBase))
        painter.drawRoundedRect(plate, 4, 4)
        painter.setPen(palette.color(QPalette.ColorRole.ToolTipText))
        painter.drawText(plate, Qt.AlignmentFlag.AlignCenter, text)
