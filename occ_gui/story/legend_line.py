"""Line of the legend: the names of the curves beside the controls, or above where it is narrow."""

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QWidget

from occ_gui.story.curve_legend import CurveLegend
from occ_gui.widgets.layouts import filled

_SPACING = 6


class LegendLine(QWidget):
    """A legend, and at its right the controls of what is shown."""

    def __init__(self, legend: CurveLegend) -> None:
        super().__init__()
        self._legend = legend
        self.controls = filled(QHBoxLayout(), (None, 0), spacing=_SPACING)
        self._layout = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(_SPACING)
        self._layout.addWidget(legend, 1)
        self._layout.addLayout(self.controls)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        beside = self.contentsRect().width() - self.controls.sizeHint().width() - _SPACING
        way = QBoxLayout.Direction
        direction = way.LeftToRight if beside >= self._legend.widest else way.TopToBottom
        if direction != self._layout.direction():
            self._layout.setDirection(direction)
