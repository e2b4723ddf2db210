"""Legend of the theoretical limits, with a button that shows or hides each line."""

from collections.abc import Collection

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QIcon, QPainter, QPalette, QPen, QPixmap
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from occ_gui.detection_map.map_plot import STYLES
from occ_gui.widgets.layouts import filled

_SAMPLE = QSize(28, 12)

_REDRAWN_AT = (QEvent.Type.PaletteChange, QEvent.Type.DevicePixelRatioChange)


class MapLegend(QWidget):
    toggled = Signal(str, bool)  # the name of a limit, and whether its line is shown

    def __init__(self) -> None:
        super().__init__()
        words = {
            "band": (
                "t = 1 chip",
                "The exposure lasts as long as a chip: the band model ends.",
            ),
            "null": (
                "null, f = 2/t",
                "The exposure lasts two chips: alternating chips leave no stripes.",
            ),
            "packets": (
                "two packets",
                "Below this frequency no two packets fit the panel's image.",
            ),
            "saturation": ("white", "The lit panel reaches the largest value."),
        }
        row = filled(QHBoxLayout(self), margins=0, spacing=2)
        self.buttons: dict[str, QToolButton] = {}
        for key, (text, meaning) in words.items():
            button = self._button(key, text, meaning)
            self.buttons[key] = button
            row.addWidget(button)
        row.addStretch(1)
        self._draw_samples()

    def _button(self, key: str, text: str, meaning: str) -> QToolButton:
        button = QToolButton()
        button.setText(text)
        button.setIconSize(_SAMPLE)
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        button.setAutoRaise(True)
        button.setCheckable(True)
        button.setChecked(True)
        button.setEnabled(False)
        button.setToolTip(meaning)
        button.setAccessibleName(text)
        button.toggled.connect(lambda shown: self.toggled.emit(key, shown))
        return button

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() in _REDRAWN_AT:
            self._draw_samples()

    def _draw_samples(self) -> None:
        for key, button in self.buttons.items():
            button.setIcon(QIcon(self._sample(STYLES[key])))

    def _sample(self, style: Qt.PenStyle) -> QPixmap:
        scale = self.devicePixelRatioF()
        pixmap = QPixmap(_SAMPLE * scale)
        pixmap.setDevicePixelRatio(scale)
        pixmap.fill(Qt.GlobalColor.transparent)
        painter = QPainter(pixmap)
        painter.setPen(QPen(self.palette().color(QPalette.ColorRole.WindowText), 2, style))
        painter.drawLine(0, _SAMPLE.height() // 2, _SAMPLE.width(), _SAMPLE.height() // 2)
        painter.end()
        return pixmap

    def enable_limits(self, limits: Collection[str]) -> None:
        for key, button in self.buttons.items():
            button.setEnabled(key in limits)
