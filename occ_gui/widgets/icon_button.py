"""A button with an icon that is drawn when it is first seen, and follows the theme."""

from PySide6.QtCore import QEvent, QSize
from PySide6.QtGui import QPaintEvent
from PySide6.QtWidgets import QToolButton

from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.icons import icon


class IconButton(QToolButton):
    """A flat button that shows an icon.

    ``size``: its width and height, independent of the screen.
    """

    def __init__(self, drawing: str, size: int) -> None:
        super().__init__()
        self._drawing, self._size, self._is_drawn = drawing, size, False
        self.setAutoRaise(True)
        self.setIconSize(QSize(size, size))

    def show_drawing(self, drawing: str) -> None:
        self._drawing = drawing
        if self._is_drawn:
            self._draw()

    def _draw(self) -> None:
        self._is_drawn = True
        self.setIcon(icon(self._drawing, self.palette(), self._size, self.devicePixelRatioF()))

    @guarded
    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw the icon when it is first seen, not with the program."""
        if not self._is_drawn:
            self._draw()
        super().paintEvent(event)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._is_drawn:
            self._draw()
