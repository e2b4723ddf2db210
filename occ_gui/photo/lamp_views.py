"""Lamps of a photo, and a region drawn by hand: in a form, and as outlines on the photo itself."""

import weakref
from collections.abc import Sequence

import pyqtgraph as pg
from pyqtgraph.GraphicsScene.mouseEvents import MouseDragEvent
from PySide6.QtCore import QObject, QPointF, QRectF, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QPen, QPolygonF
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.widgets.building import fill, make_read_only, name_widget, push_button
from occ_gui.widgets.colours import PHOTO, REGION
from occ_gui.widgets.guarded_paint import guarded
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.scene.scene import Scene
from occ_model.scene.units import NONE

_MOST_ROWS = 6  # rows of the table that are visible without scrolling
_ROW_HEIGHT = 24

_THIN, _THICK = 2, 4  # pen widths in pixels
_LAYER = 20  # z value of the outlines

_HALF_SIDE = 1e6  # half the side of the area for drawing, in pixels
_HANDLE = 9  # half the size of a corner's handle in pixels: large enough to be hit


class PartForm(QWidget):
    """Lets the user choose what is matched: the photo, a lamp, or a rectangle drawn by hand."""

    find_asked = Signal()
    chosen = Signal(int)  # the user chose the lamp of this index
    by_hand_chosen = Signal(bool)  # whether the user matches a rectangle drawn on the photo
    whole_asked = Signal()  # the user matches the whole photo again

    def __init__(self) -> None:
        super().__init__()
        self.search = push_button(
            "Find &lamps",
            "Find every lamp in the photo, and whether its light changes during the readout of "
            "the picture. Choose a lamp to match it alone.",
            self.find_asked,
        )
        self.by_hand = push_button(
            "Draw a re&gion",
            "Match only a rectangle. Drag its middle to move it and its corners to resize it; "
            "drag elsewhere on the photo to draw another one.",
        )
        self.by_hand.setCheckable(True)
        self.by_hand.toggled.connect(self.by_hand_chosen)
        self.whole_photo = push_button(
            "&Whole photo", "Search the whole photo for stripes again.", self.whole_asked
        )
        self.target = name_widget(QLabel(wordWrap=True), "What is matched")
        self._make_table()
        buttons = fill(QHBoxLayout(), self.search, self.by_hand, self.whole_photo, None)
        fill(QVBoxLayout(self), buttons, self.table, self.target, margins=0, spacing=4)
        self._shown = ShownPhoto(Scene())
        self._show_lamps((), None)
        self.show_photo(self._shown)

    def _make_table(self) -> None:
        self.table = make_read_only(
            QTableWidget(0, 4),
            "Lamps in the photo",
            "The lamps, brightest first: the columns that each one covers, its period, or a code's "
            "chip, in columns with its standard deviation, and the number of periods in view. The "
            "tooltip of a doubtful lamp says why.",
        )
        self.table.setHorizontalHeaderLabels(["Lamp", "Columns", "Period (px)", "Periods"])
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setStretchLastSection(True)
        self.table.itemSelectionChanged.connect(self._choose)

    def show_photo(self, shown: ShownPhoto) -> None:
        """Show the lamps of a photo, and which part of it is matched."""
        last, self._shown = self._shown, shown
        if (shown.lamps, shown.part) != (last.lamps, last.part):
            self._show_lamps(shown.lamps, shown.chosen_lamp)
        lamp, match = shown.chosen_lamp, shown.present_match
        region = shown.rectangle if lamp is None else shown.lamps[lamp].region
        self._show_region(region, lamp, None if match is None else match.region)
        with QSignalBlocker(self.by_hand):
            self.by_hand.setChecked(shown.rectangle is not None)
        _, is_searching, reason = shown.search
        self.search.setEnabled(not is_searching)
        if is_searching or reason:
            self.target.setText("Searching for lamps…" if is_searching else reason)

    def _show_lamps(self, lamps: Sequence[Lamp], chosen: int | None) -> None:
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(lamps))
            for row, lamp in enumerate(lamps):
                for column, text in enumerate(self._row_texts(row, lamp)):
                    item = QTableWidgetItem(text)
                    item.setToolTip("\n".join(f"Doubtful: {doubt}." for doubt in lamp.doubts))
                    self.table.setItem(row, column, item)
            self.table.clearSelection()
            if chosen is not None:
                self.table.selectRow(chosen)
        rows = min(len(lamps), _MOST_ROWS)
        header = self.table.horizontalHeader().sizeHint().height()
        self.table.setFixedHeight(header + rows * _ROW_HEIGHT + 4)
        self.table.setVisible(bool(lamps))

    def _row_texts(self, row: int, lamp: Lamp) -> tuple[str, str, str, str]:
        region = lamp.region
        columns = f"{region.first_column}\u2013{region.last_column - 1}"
        product, doubt = lamp.switching_frequency_times_readout, ", doubtful" * lamp.is_doubtful
        if product is None:
            return str(row + 1), columns, "no stripes", ""
        if lamp.period is not None:
            period = NONE.format_estimate(lamp.period, lamp.period_uncertainty)
            return str(row + 1), columns, period, f"{lamp.periods or 0.0:.1f}{doubt}"
        error = None if lamp.product_uncertainty is None else lamp.product_uncertainty / product**2
        chip = NONE.format_estimate(1.0 / product, error)
        return str(row + 1), columns, f"chip {chip}", f"code{doubt}"

    def _show_region(self, region: Region | None, lamp: int | None, fitted: Region | None) -> None:
        """Show what is matched: a rectangle, a lamp of this index, or the whole photo.

        ``fitted``: where a match of the whole photo has found the stripes.
        """
        self.whole_photo.setEnabled(region is not None)
        if region is not None:
            subject = "A drawn region" if lamp is None else f"Lamp {lamp + 1}"
            hint = " Drag on the photo to draw another one." if lamp is None else ""
            text = f"{subject} will be matched: {_describe_place(region)}.{hint}"
        elif fitted is not None:
            text = f"Found in the whole photo: {_describe_place(fitted)}."
        else:
            text = "The whole photo will be searched for stripes."
        self.target.setText(text)

    def _choose(self) -> None:
        rows = {item.row() for item in self.table.selectedItems()}
        if len(rows) == 1:
            self.chosen.emit(rows.pop())


def _describe_place(region: Region) -> str:
    return (
        f"columns {region.first_column} to {region.last_column - 1}, "
        f"rows {region.first_row} to {region.last_row - 1}"
    )


class _DrawingArea(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """An area over the whole photo in which dragging with the left button draws a rectangle."""

    dragged = Signal(object, bool)
    """The rectangle from where the button was pressed, and whether the drag has ended."""

    def boundingRect(self) -> QRectF:  # noqa: N802 - Qt's name
        return QRectF(-_HALF_SIDE, -_HALF_SIDE, 2.0 * _HALF_SIDE, 2.0 * _HALF_SIDE)

    @guarded
    def paint(self, *_arguments: object) -> None:
        """Draw nothing."""

    def mouseDragEvent(self, event: MouseDragEvent) -> None:  # noqa: N802 - pyqtgraph's name
        if event.button() != Qt.MouseButton.LeftButton:
            event.ignore()
            return
        event.accept()
        corners = QRectF(event.buttonDownPos(), event.pos()).normalized()
        self.dragged.emit(corners, event.isFinish())


class LampOutlines(QObject):
    """Outlines of the lamps and a movable rectangle, drawn on a photo.

    The centre of the photo's first pixel is at (0, 0).
    """

    clicked = Signal(int)  # the user clicked the lamp of this index
    drawn = Signal(object)  # the user drew another rectangle: a Region, which may leave the photo

    def __init__(self, box: pg.ViewBox) -> None:
        super().__init__()
        # A weak reference: the view holds the rectangle, and its signal holds this object.
        self._box = weakref.proxy(box)
        self._shown = ShownPhoto(Scene())
        self.items: list[tuple[pg.PlotCurveItem, pg.TextItem]] = []
        self._is_updating = False
        self.rectangle = pg.ROI((0, 0), (1, 1), pen=pg.mkPen(REGION, width=_THIN))
        self.rectangle.handleSize = _HANDLE
        for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
            self.rectangle.addScaleHandle(corner, (1 - corner[0], 1 - corner[1]))
        self.rectangle.sigRegionChangeFinished.connect(self._emit_region)
        self.area = _DrawingArea()
        self.area.setCursor(Qt.CursorShape.CrossCursor)
        self.area.dragged.connect(self._draw_rectangle)
        # The area lies under the rectangle, which handles drags on itself.
        for z_value, item in enumerate((self.area, self.rectangle), _LAYER):
            item.setZValue(z_value)
            item.hide()
            box.addItem(item, ignoreBounds=True)

    def show_photo(self, shown: ShownPhoto) -> None:
        last, self._shown = self._shown, shown
        if (shown.lamps, shown.part) != (last.lamps, last.part):
            self._show_lamps(shown.lamps, shown.chosen_lamp)
            self._show_rectangle(shown.rectangle)

    def _show_lamps(self, lamps: Sequence[Lamp], chosen: int | None) -> None:
        for item in (item for items in self.items for item in items):
            self._box.removeItem(item)
        self.items = [
            self._draw_outline(index, lamp, index == chosen) for index, lamp in enumerate(lamps)
        ]

    def _draw_outline(
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
            item.setZValue(_LAYER)
            self._box.addItem(item, ignoreBounds=True)
        return curve, number

    def click(self, position: QPointF) -> None:
        row, column = round(position.y()), round(position.x())
        for index, lamp in enumerate(self._shown.lamps):
            outline = QPolygonF([QPointF(x, y) for x, y in lamp.outline.tolist()])
            if lamp.covers(row, column) or outline.containsPoint(position, Qt.FillRule.OddEvenFill):
                self.clicked.emit(index)
                return

    def _show_rectangle(self, region: Region | None) -> None:
        self.rectangle.setVisible(region is not None)
        self.area.setVisible(region is not None)
        if region is not None:
            left, top = region.first_column - 0.5, region.first_row - 0.5
            self._place_rectangle(QRectF(left, top, region.columns, region.rows))

    def _place_rectangle(self, rect: QRectF) -> None:
        self._is_updating = True
        self.rectangle.setPos(rect.topLeft(), update=False)
        self.rectangle.setSize(rect.size())
        self._is_updating = False

    def _draw_rectangle(self, corners: QRectF, has_ended: bool) -> None:
        self._place_rectangle(corners)
        if has_ended:
            self._emit_region()

    def _emit_region(self) -> None:
        if self._is_updating:
            return
        corner, size = self.rectangle.pos(), self.rectangle.size()
        rect = QRectF(corner.x(), corner.y(), size.x(), size.y()).normalized()
        rows, columns = (rect.top(), rect.bottom()), (rect.left(), rect.right())
        self.drawn.emit(Region(*(round(edge + 0.5) for edge in (*rows, *columns))))
