"""Icons from SVG drawings, in the colours of a palette and sharp on any screen."""

from functools import cache

from PySide6.QtCore import QByteArray, QEvent, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPaintEvent, QPalette, QPixmap
from PySide6.QtWidgets import QToolButton

from occ_gui.widgets.guarded_paint import guarded
from occ_model.files.resources import resource_text

PROGRAM = "occ-explorer"

PROGRAM_SIZES = (16, 32, 48, 64, 128, 256)  # sides of the program's icon in pixels

_FOLDER, _ENDING = "icons", ".svg"
_INK = "currentColor"  # the drawings' placeholder for a colour, as in CSS


@cache
def _read_drawing(name: str) -> str:
    return resource_text(_FOLDER, f"{name}{_ENDING}")


def icon(name: str, palette: QPalette, size: int, ratio: float) -> QIcon:
    """Draw an icon for a screen, in the text colours of a palette.

    ``size``: width and height in device-independent pixels.
    ``ratio``: screen pixels per device-independent pixel.
    """
    new_icon = QIcon()
    for mode, group in (
        (QIcon.Mode.Normal, QPalette.ColorGroup.Active),
        (QIcon.Mode.Disabled, QPalette.ColorGroup.Disabled),
    ):
        colour = palette.color(group, QPalette.ColorRole.WindowText)
        new_icon.addPixmap(pixmap(name, colour, size, ratio), mode)
    return new_icon


def program_icon() -> QIcon:
    new_icon = QIcon()
    for size in PROGRAM_SIZES:
        new_icon.addPixmap(pixmap(PROGRAM, QColor(), size, 1.0))
    return new_icon


def pixmap(name: str, colour: QColor, size: int, ratio: float) -> QPixmap:
    """Draw an icon in one colour; the parameters are those of :func:`icon`."""
    # Imported with the first icon that is shown, not when the program starts.
    from PySide6.QtSvg import QSvgRenderer

    side = round(size * ratio)
    image = QPixmap(side, side)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    drawing = _read_drawing(name).replace(_INK, colour.name())
    QSvgRenderer(QByteArray(drawing.encode())).render(painter)
    painter.end()
    image.setDevicePixelRatio(ratio)
    return image


class IconButton(QToolButton):
    """A flat button with an icon of ``size`` device-independent pixels."""

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
        """Draw the icon when the button is first shown, not when the program starts."""
        if not self._is_drawn:
            self._draw()
        super().paintEvent(event)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._is_drawn:
            self._draw()
