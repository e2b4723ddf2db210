"""Text size: enlarges all text of the application, for example for a projector."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication, QWidget

from occ_gui.widgets.building import resize_font

SIZES = (100, 115, 130)  # percent of the system's size of text, the normal one first

_SET_FONT = Qt.WidgetAttribute.WA_SetFont
_HAS_SIZE = 0x0002  # the bit of Qt's resolve mask of a font whose size is set


class TextSize(QObject):
    """The size of all text, relative to that of the system.

    All text sizes are multiples of the application's font size. Existing widgets are scaled with
    it, and new widgets start with it.
    """

    chosen = Signal(int)  # the size from now on, one of SIZES

    def __init__(self) -> None:
        super().__init__()
        self.percent = SIZES[0]

    def enlarge(self) -> None:
        self.choose(SIZES[min(SIZES.index(self.percent) + 1, len(SIZES) - 1)])

    def reduce(self) -> None:
        self.choose(SIZES[max(SIZES.index(self.percent) - 1, 0)])

    def reset(self) -> None:
        self.choose(SIZES[0])

    def choose(self, percent: int) -> None:
        """Change the size and emit a signal; a size not among SIZES changes nothing."""
        if percent not in SIZES:
            return
        if percent != self.percent:
            self._scale_to(percent)
        self.chosen.emit(percent)

    def _scale_to(self, percent: int) -> None:
        factor = percent / self.percent
        self.percent = percent
        fonts = [(widget, resize_font(widget.font(), factor)) for widget in _list_own_sizes()]
        QApplication.setFont(resize_font(QApplication.font(), factor))
        for widget, font in fonts:
            widget.setFont(font)


def _list_own_sizes() -> list[QWidget]:
    """Return the widgets whose text size was set, and is not inherited."""
    return [
        widget
        for widget in QApplication.allWidgets()
        if widget.testAttribute(_SET_FONT) and widget.font().resolveMask() & _HAS_SIZE
    ]
