"""Elided label: shortens a text that is too long, and adds dots."""

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel

from occ_gui.widgets.plain_text import LONGEST_TEXT, in_tool_tip
from occ_model.errors import one_line


class ElidedLabel(QLabel):
    """Shows as much of a text as fits, and the whole text in the tooltip."""

    def __init__(
        self, text: str = "", *, how: Qt.TextElideMode = Qt.TextElideMode.ElideRight
    ) -> None:
        super().__init__()
        self._how = how
        self._full = ""
        self._fitted_to: tuple[str, int] | None = None
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.set_full_text(text)

    def set_full_text(self, text: str) -> None:
        full = one_line(text, LONGEST_TEXT)
        if full != self._full:
            self._full = full
            self.setToolTip(in_tool_tip(full))
        self._fit()

    def _fit(self) -> None:
        wanted = (self._full, self.contentsRect().width())
        if wanted != self._fitted_to:  # setting a text lays out the surrounding widgets again
            self._fitted_to = wanted
            self.setText(self.fontMetrics().elidedText(self._full, self._how, wanted[1]))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_how"):
            self._fitted_to = None
            self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._fit()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a width of zero: the label can be narrower than its text."""
        return QSize(0, super().minimumSizeHint().height())
