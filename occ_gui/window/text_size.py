"""Text size: all text of the application larger, as for a projector, or smaller again."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication, QWidget

from occ_gui.widgets.text_scale import resize_font

SIZES = (100, 115, 130)  # percent of the system's size of text, the normal one first

_SET_FONT = Qt.WidgetAttribute.WA_SetFont
_HAS_SIZE = 0x0002  # the bit of Qt's resolve mask of a font whose size is set


class TextSize(QObject):
    """The size of all text, relative to that of the system.

    All sizes of text are factors of the application's font. Those of widgets that are there are
    scaled with it; a widget that is made later begins with the application's font.
    """

    chosen = Signal(int)  # the size from now on, one of SIZES

    def __init__(self) -> None:
        super().__init__()
        self.percent = SIZES[0]

    def larger(self) -> None:
        self.choose(SIZES[min(SIZES.index(self.percent) + 1, len(SIZES) - 1)])

    def smaller(self) -> None:
        self.choose(SIZES[max(SIZES.index(self.percent) - 1, 0)])

    def normal(self) -> None:
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
        own = [(widget, resize_font(widget.font(), factor)) for widget in _with_own_size()]
        QApplication.setFont(resize_font(QApplication.font(), factor))
        for widget, font in own:
            widget.setFont(font)


def _with_own_size() -> list[QWidget]:
    """Return the widgets whose size of text was set, and is not that of the widget around."""
    return [
        widget
        for widget in QApplication.allWidgets()
        if widget.testAttribute(_SET_FONT) and widget.font().resolveMask() & _HAS_SIZE
    ]
