"""Failure banner: why a file was not opened or saved, on top of the window's middle."""

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QAccessible, QAccessibleEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QFrame, QHBoxLayout, QMainWindow, QWidget

from occ_gui.widgets.building import fill, paragraph, push_button
from occ_gui.widgets.state_look import State, StateIcon

_WIDEST, _MARGIN, _GAP, _ICON = 620, 24, 8, 24
"""Pixels: greatest width, least distance from the sides, gap above, and side of the icon."""


class FailureBanner(QFrame):
    """A sentence over the panes, below the toolbar, until it is closed or no longer holds."""

    def __init__(self, window: QMainWindow, above: QWidget) -> None:
        """``above``: the widget below which the banner stands."""
        super().__init__(window)
        self.setObjectName("card")
        self.setAutoFillBackground(True)
        icon = StateIcon(_ICON)
        icon.show_state(State.BAD)
        self.sentence = paragraph(name="Failure", is_selectable=True)
        self.close_button = push_button("Close", "Remove this message.", self.hide)
        high = Qt.AlignmentFlag.AlignTop
        fill(
            QHBoxLayout(self), (icon, 0, high), (self.sentence, 1), (self.close_button, 0, high),
            margins=12, spacing=10,
        )  # fmt: skip
        shortcut = QShortcut(QKeySequence(Qt.Key.Key_Escape), self)
        shortcut.activated.connect(self.hide)
        self._window, self._above = window, above
        window.installEventFilter(self)
        self.hide()

    def show_sentence(self, sentence: str) -> None:
        self.sentence.setText(sentence)
        self.show()
        self._place()
        self.raise_()
        QAccessible.updateAccessibility(QAccessibleEvent(self.sentence, QAccessible.Event.Alert))

    def _place(self) -> None:
        width = min(_WIDEST, self._window.width() - 2 * _MARGIN)
        height = max(self.heightForWidth(width), self.sizeHint().height())
        top = self._above.geometry().bottom() + _GAP
        self.setGeometry((self._window.width() - width) // 2, top, width, height)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        return super().eventFilter(watched, event)
