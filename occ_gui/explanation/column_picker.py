"""Column picker: choose a column of a profile by mouse, by a click, or with the arrow keys."""

import pyqtgraph as pg
from pyqtgraph.GraphicsScene.mouseEvents import MouseClickEvent
from PySide6.QtCore import QEvent, QObject, QPointF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QPalette

from occ_gui.widgets.pens import thin
from occ_gui.widgets.plot import Plot

_STEPS = {
    Qt.Key.Key_Left: -1,
    Qt.Key.Key_Right: 1,
    Qt.Key.Key_PageDown: -10,
    Qt.Key.Key_PageUp: 10,
}


class ColumnPicker(QObject):
    """Marks a column of a plot, and emits a signal for the column that the user picks."""

    hovered = Signal(int)
    clicked = Signal(int)

    stepped = Signal(int)  # the number of columns to move on, negative to the left

    released = Signal()

    def __init__(self, plot: Plot) -> None:
        super().__init__(plot)
        self._plot = plot
        self._box = plot.getViewBox()
        self._active = False
        self._last: int | None = None
        self._held = False
        self.marker = pg.InfiniteLine(angle=90)
        self.marker.setZValue(20)
        self.marker.hide()
        plot.addItem(self.marker, ignoreBounds=True)
        plot.scene().sigMouseMoved.connect(self._hover)
        plot.scene().sigMouseClicked.connect(self._click)
        plot.installEventFilter(self)
        plot.dress_with(self._dress)

    def set_active(self, active: bool) -> None:
        self._active = active
        self.marker.setVisible(active)

    def show_column(self, column: int, held: bool) -> None:
        """Mark a column by a dashed line, or by a solid line if it is held."""
        self._held = held
        self._dress(self._plot.palette())
        self.marker.setValue(column)
        self._last = column

    def _dress(self, palette: QPalette) -> None:
        style = Qt.PenStyle.SolidLine if self._held else Qt.PenStyle.DashLine
        self.marker.setPen(thin(palette.color(QPalette.ColorRole.Text), style))

    def _hover(self, place: QPointF) -> None:
        column = self._column_at(place)
        if self._active and column is not None and column != self._last:
            self._last = column
            self.hovered.emit(column)

    def _click(self, event: MouseClickEvent) -> None:
        column = self._column_at(event.scenePos())
        if self._active and column is not None and event.button() == Qt.MouseButton.LeftButton:
            self.clicked.emit(column)

    def _column_at(self, place: QPointF) -> int | None:
        if not self._box.sceneBoundingRect().contains(place):
            return None
        return int(round(self._box.mapSceneToView(place).x()))  # noqa: RUF046 - it has no type

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Move from column to column by the arrow keys, and release the held one by Escape."""
        if self._active and event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            key = Qt.Key(event.key())
            if key in _STEPS:
                self.stepped.emit(_STEPS[key])
                return True
            if key == Qt.Key.Key_Escape:
                self.released.emit()
                return True
        return super().eventFilter(watched, event)
