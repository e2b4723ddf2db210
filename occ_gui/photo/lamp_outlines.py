"""Outlines of the lamps on the photo, each with its number, and a rectangle drawn by hand."""

import weakref
from collections.abc import Sequence

import pyqtgraph as pg
from pyqtgraph.GraphicsScene.mouseEvents import MouseDragEvent
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QPen, QPolygonF

from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.pens import PHOTO, REGION
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp

_THIN, _THICK = 2, 4
_ABOVE = 20

_HALF_SIDE = 1e6
"""Half the side of the area for drawing, in pixels."""

_HANDLE = 9
"""Half the size of a corner's handle in pixels: large enough to be hit."""


class _DrawingArea(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """Takes drags of the left button anywhere on a photo: each draws a rectangle."""

    dragged = Signal(object, bool)
    """The rectangle from where the button was pressed, and whether the drag has ended."""

    def boundingRect(self) -> QRectF:  # noqa: N802 - Qt's name
        """Return an area larger than any photo."""
        return QRectF(-_HALF_SIDE, -_HALF_SIDE, 2.0 * _HALF_SIDE, 2.0 * _HALF_SIDE)

    @guarded
    def paint(self, *_arguments: object) -> None:
        """Draw nothing."""

    def mouseDragEvent(self, event: MouseDragEvent) -> None:  # noqa: N802 - pyqtgraph's name
        """Draw a rectangle; other buttons move the picture."""
        if event.button() != Qt.MouseButton.LeftButton:
            event.ignore()
            return
        event.accept()
        corners = QRectF(event.buttonDownPos(), event.pos()).normalized()
        self.dragged.emit(corners, event.isFinish())


class LampOutlines(QObject):
    """Draws on the view of a photo, whose first pixel's centre is at (0, 0)."""

    clicked = Signal(int)
    """The user clicked the lamp of this index."""

    drawn = Signal(object)
    """The user drew another rectangle: a Region, which may leave the photo."""

    def __init__(self, box: pg.ViewBox) -> None:
        super().__init__()
        # Weak: a signal of the rectangle, which the view holds, holds this object.
        self._box = weakref.proxy(box)
        self._lamps: Sequence[Lamp] = ()
        self.items: list[tuple[pg.PlotCurveItem, pg.TextItem]] = []
        self._updating = False
        self.rectangle = pg.ROI((0, 0), (1, 1), pen=pg.mkPen(REGION, width=_THIN))
        self.rectangle.handleSize = _HANDLE
        for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
            self.rectangle.addScaleHandle(corner, (1 - corner[0], 1 - corner[1]))
        self.rectangle.setZValue(_ABOVE + 1)
        self.rectangle.hide()
        self.rectangle.sigRegionChangeFinished.connect(self._follow)
        box.addItem(self.rectangle, ignoreBounds=True)
        self.area = _DrawingArea()
        self.area.setZValue(_ABOVE)  # under the rectangle, which moves by itself
        self.area.setCursor(Qt.CursorShape.CrossCursor)
        self.area.hide()
        self.area.dragged.connect(self._draw_rectangle)
        box.addItem(self.area, ignoreBounds=True)

    def show_lamps(self, lamps: Sequence[Lamp], chosen: int | None) -> None:
        """Draw the outlines of these lamps, that of the chosen one thicker."""
        for curve, number in self.items:
            self._box.removeItem(curve)
            self._box.removeItem(number)
        self.items = []
        self._lamps = lamps
        for index, lamp in enumerate(lamps):
            self.items.append(self._draw(index, lamp, index == chosen))

    def _draw(
        self, index: int, lamp: Lamp, is_chosen: bool
    ) -> tuple[pg.PlotCurveItem, pg.TextItem]:
        pen = QPen(REGION if is_chosen else PHOTO, _THICK if is_chosen else _THIN)
        pen.setCosmetic(True)
        if not lamp.modulated:
            pen.setStyle(Qt.PenStyle.DotLine)
        outline = lamp.outline
        curve = pg.PlotCurveItem(outline[:, 0], outline[:, 1], pen=pen)
        number = pg.TextItem(str(index + 1), color=pen.color(), anchor=(0, 1), fill=(0, 0, 0, 160))
        number.setPos(lamp.region.first_column, lamp.region.first_row)
        for item in (curve, number):
            item.setZValue(_ABOVE)
            self._box.addItem(item, ignoreBounds=True)
        return curve, number

    def click(self, position: QPointF) -> None:
        """Choose the lamp at a place in the photo, if there is one."""
        row, column = round(position.y()), round(position.x())
        for index, lamp in enumerate(self._lamps):
            outline = QPolygonF([QPointF(x, y) for x, y in lamp.outline.tolist()])
            if lamp.covers(row, column) or outline.containsPoint(position, Qt.FillRule.OddEvenFill):
                self.clicked.emit(index)
                return

    def show_rectangle(self, region: Region | None) -> None:
        """Draw this rectangle for the mouse, or none."""
        self.rectangle.setVisible(region is not None)
        self.area.setVisible(region is not None)
        if region is None:
            return
        self._updating = True
        self.rectangle.setPos((region.first_column - 0.5, region.first_row - 0.5), update=False)
        self.rectangle.setSize((region.columns, region.rows))
        self._updating = False

    def _draw_rectangle(self, corners: QRectF, has_ended: bool) -> None:
        self._updating = True
        self.rectangle.setPos(corners.topLeft(), update=False)
        self.rectangle.setSize(corners.size())
        self._updating = False
        if has_ended:
            self._follow()

    def _follow(self) -> None:
        if self._updating:
            return
        corner, size = self.rectangle.pos(), self.rectangle.size()
        rect = QRectF(corner.x(), corner.y(), size.x(), size.y()).normalized()
        self.drawn.emit(
            Region(
                round(rect.top() + 0.5), round(rect.bottom() + 0.5),
                round(rect.left() + 0.5), round(rect.right() + 0.5),
            )
        )  # fmt: skip
