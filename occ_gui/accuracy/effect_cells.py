"""Painted cells of the table of effects: pictures, errors on their axis, times."""

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QImage, QPainter, QPalette, QPen
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from occ_gui.accuracy.effect_rows import EVERYTHING_ELSE, EffectRow, find_longest_time
from occ_gui.widgets.colours import BAND, SIMULATION, lighten_for
from occ_gui.widgets.guarded_paint import guarded
from occ_model.arrays import ByteArray

_Index = QModelIndex | QPersistentModelIndex

Rows: TypeAlias = Callable[[], Sequence[EffectRow]]

_GAP = 4  # pixels between two parts of a cell
_BAR_FRACTION = (
    0.5  # largest width of the bar as a fraction of the cell's; the number takes the rest
)


def make_image(pixels: ByteArray) -> QImage:
    """Make a grey image with a copy of the pixels."""
    rows, columns = pixels.shape
    return QImage(pixels.tobytes(), columns, rows, columns, QImage.Format.Format_Grayscale8).copy()


class _EffectCell(QStyledItemDelegate):
    def __init__(self, rows: Rows, parent: QObject) -> None:
        super().__init__(parent)
        self._rows = rows


class PictureCell(_EffectCell):
    def __init__(self, rows: Rows, parent: QObject) -> None:
        super().__init__(rows, parent)
        self._images: dict[int, tuple[object, QImage, QImage]] = {}

    @guarded
    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: _Index) -> None:
        super().paint(painter, option, index)
        row = self._rows()[index.row()]
        if row.icon is None:
            return
        images = self._images.get(index.row())
        if images is None or images[0] is not row.icon:
            images = (
                row.icon,
                make_image(row.icon.with_effect),
                make_image(row.icon.without_effect),
            )
            self._images[index.row()] = images
        area = option.rect.adjusted(_GAP // 2, 1, -_GAP // 2, -1)
        for place, image in enumerate(images[1:]):
            width = (area.width() - _GAP) // 2
            left = area.left() + place * (width + _GAP)
            painter.drawImage(_fit(QRect(left, area.top(), width, area.height()), image), image)


def _fit(area: QRect, image: QImage) -> QRect:
    """Centre an image in an area, shrunk where needed but never enlarged."""
    scale = min(area.width() / image.width(), area.height() / image.height(), 1.0)
    fitted = QRect(0, 0, round(scale * image.width()), round(scale * image.height()))
    fitted.moveCenter(area.center())
    return fitted


class TimeCell(_EffectCell):
    """Draws a time as a bar, hollow where the effect is left out, and as a number."""

    @guarded
    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: _Index) -> None:
        super().paint(painter, option, index)
        rows = self._rows()
        row, largest = rows[index.row()], find_longest_time(rows)
        if not row.seconds or not largest:
            return
        longest = _BAR_FRACTION * option.rect.width()
        width = max(1, math.floor(longest * row.seconds / largest))
        height = min(10, option.rect.height() - 8)
        top = option.rect.center().y() - height // 2
        bar = QRectF(option.rect.left() + _GAP, top, width, height)
        colour = lighten_for(option.palette, BAND if row.effect == EVERYTHING_ELSE else SIMULATION)
        if option.state & QStyle.StateFlag.State_Selected:
            colour = option.palette.color(QPalette.ColorRole.HighlightedText)
        painter.save()
        painter.setPen(colour)
        painter.setBrush(colour if row.included else Qt.BrushStyle.NoBrush)
        painter.drawRect(bar.adjusted(0.5, 0.5, -0.5, -0.5))
        painter.restore()


_LEAST_LEVELS, _MOST_LEVELS = 0.01, 300.0  # limits of the logarithmic axis of errors, in levels

_NUMBER_WIDTH = 44  # pixels of the number beside the axis


def find_axis(area: QRect) -> tuple[int, int]:
    """Return the start and the length of the axis of errors in a cell, in pixels."""
    return area.left() + _GAP, max(area.width() - _NUMBER_WIDTH - 2 * _GAP, 1)


def find_position(levels: float, area: QRect) -> float:
    """Return the position of an error on the axis, clamped to its ends."""
    left, length = find_axis(area)
    if levels <= _LEAST_LEVELS:
        return float(left)
    fraction = math.log(levels / _LEAST_LEVELS) / math.log(_MOST_LEVELS / _LEAST_LEVELS)
    return left + length * min(fraction, 1.0)


def find_levels(position: float, area: QRect) -> float:
    """Return the error at a position: 0 before the axis, and infinity beyond it."""
    left, length = find_axis(area)
    fraction = (position - left) / length
    if fraction <= 0.0:
        return 0.0
    levels: float = _LEAST_LEVELS * (_MOST_LEVELS / _LEAST_LEVELS) ** fraction
    return levels if fraction < 1.0 else math.inf


class ErrorCell(_EffectCell):
    """Draws an effect's error as a dot, with a whisker to the plan's limit of it.

    The tolerance is a line through all rows; errors beyond it are coloured.
    """

    def __init__(self, rows: Rows, tolerance: Callable[[], float], parent: QObject) -> None:
        super().__init__(rows, parent)
        self._tolerance = tolerance

    @guarded
    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: _Index) -> None:
        super().paint(painter, option, index)
        row, area = self._rows()[index.row()], option.rect
        colour = lighten_for(option.palette, SIMULATION)
        text = option.palette.color(QPalette.ColorRole.Text)
        if option.state & QStyle.StateFlag.State_Selected:
            colour = text = option.palette.color(QPalette.ColorRole.HighlightedText)
        middle = area.center().y() + 0.5
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if row.effect != EVERYTHING_ELSE:
            painter.setPen(text)
            x = find_position(self._tolerance(), area)
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom() + 1))
        if row.limit is not None and row.levels is not None:
            if row.limit <= self._tolerance() and colour != text:
                colour = option.palette.color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Text)
            painter.setPen(QPen(colour, 1.5))
            limit, error = find_position(row.limit, area), find_position(row.levels, area)
            painter.drawLine(QPointF(limit, middle), QPointF(error, middle))
            painter.drawLine(QPointF(limit, middle - 4), QPointF(limit, middle + 4))
            if row.error_text[0] not in "≈?":
                painter.setBrush(colour if row.included else Qt.BrushStyle.NoBrush)
                painter.drawEllipse(QPointF(error, middle), 3.0, 3.0)
        painter.restore()
