"""Parts of a window that are cut off, squeezed or covered, by geometry and font metrics."""

from collections import defaultdict
from collections.abc import Callable, Iterator
from itertools import combinations
from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QFontMetricsF, QTextDocument
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractScrollArea,
    QAbstractSpinBox,
    QCheckBox,
    QComboBox,
    QDockWidget,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QSlider,
    QStyle,
    QStyleOptionComboBox,
    QTabBar,
    QTableView,
    QToolButton,
    QWidget,
)

from occ_gui.scene.slider_scale import SliderScale
from occ_gui.widgets.building import ElidedLabel

CONTROLS = (
    QLabel, QPushButton, QToolButton, QLineEdit, QAbstractSpinBox, QComboBox, QCheckBox, QSlider,
    QTabBar, QTableView, SliderScale,
)  # fmt: skip

SHORTEST_SLIDER = 80
"""Least length of a slider in pixels."""


def visible_controls(window: QWidget) -> list[QWidget]:
    return [
        control
        for control in window.findChildren(QWidget)
        if isinstance(control, CONTROLS)
        and control.isVisible()
        and not isinstance(control.parentWidget(), QAbstractSpinBox | QComboBox | QTabBar)
        and control.objectName() != "qt_toolbar_ext_button"
        # Qt keeps the tab bars of former layouts outside the window.
        and not (isinstance(control, QTabBar) and control.visibleRegion().isEmpty())
        and not is_behind(control)
    ]


def is_behind(control: QWidget) -> bool:
    """Return whether a control is in a dock behind another one."""
    parent = control.parentWidget()
    while parent is not None and not isinstance(parent, QDockWidget):
        parent = parent.parentWidget()
    return parent is not None and parent.visibleRegion().isEmpty()


def is_in_scroll_area(control: QWidget) -> bool:
    parent = control.parentWidget()
    while parent is not None and not isinstance(parent, QAbstractScrollArea):
        parent = parent.parentWidget()
    return parent is not None


def is_too_small(control: QWidget) -> bool:
    least = control.minimumSizeHint()
    high = control.height() >= least.height()
    if isinstance(control, QLabel) and control.wordWrap():
        high = control.height() >= control.heightForWidth(control.width())
    return control.width() < least.width() or not high


def is_cut_off(control: QWidget) -> bool:
    """Return whether part of a control can neither be seen nor reached by vertical scrolling."""
    visible = control.visibleRegion().boundingRect()
    if is_in_scroll_area(control):
        return not visible.isEmpty() and visible.width() < control.width()
    return visible != control.rect()


def _width_of(text: str, widget: QWidget) -> float:
    metrics = QFontMetricsF(widget.font())
    return max((metrics.horizontalAdvance(line) for line in text.splitlines()), default=0.0)


def _is_label_cut(label: QLabel) -> bool:
    if isinstance(label, ElidedLabel):
        return label.text().endswith("…") and not label._full.endswith("…")
    text, room = label.text(), label.contentsRect().width()
    if label.wordWrap() or not text:
        return False
    document = QTextDocument(defaultFont=label.font())
    if label.textFormat() == Qt.TextFormat.RichText or "<" in text:
        document.setHtml(text)
    else:
        document.setPlainText(text)
    document.setDocumentMargin(0)
    return document.idealWidth() > room + 1


def _is_field_cut(field: QLineEdit) -> bool:
    margins = field.textMargins()
    room = field.contentsRect().width() - margins.left() - margins.right()
    return _width_of(field.text() or field.placeholderText(), field) > room


def _is_spin_box_cut(box: QAbstractSpinBox) -> bool:
    line = box.findChild(QLineEdit)
    return line is not None and _width_of(line.text(), line) > line.width()


def _is_choice_cut(box: QComboBox) -> bool:
    option = QStyleOptionComboBox()
    box.initStyleOption(option)
    room = box.style().subControlRect(
        QStyle.ComplexControl.CC_ComboBox, option, QStyle.SubControl.SC_ComboBoxEditField, box
    )
    text = box.currentText() if box.currentIndex() >= 0 else box.placeholderText()
    icon = box.iconSize().width() + 4 if not box.itemIcon(box.currentIndex()).isNull() else 0
    return _width_of(text, box) + icon > room.width()


def _is_button_cut(button: QAbstractButton) -> bool:
    return button.width() < button.sizeHint().width() and bool(button.text())


def _is_tab_bar_cut(bar: QTabBar) -> bool:
    needed = sum(bar.tabSizeHint(place).width() for place in range(bar.count()))
    return needed > bar.width()


def _list_cut_cells(table: QTableView) -> Iterator[str]:
    model, header = table.model(), table.horizontalHeader()
    if model is None:
        return
    for column in range(model.columnCount()):
        if table.isColumnHidden(column):
            continue
        title = model.headerData(column, Qt.Orientation.Horizontal)
        if header.isVisible() and _is_header_cut(header, column):
            yield f"header {title!r}"
        for row in range(model.rowCount()):
            index = model.index(row, column)
            if table.indexWidget(index) is None and not table.wordWrap():
                room = table.columnWidth(column)
                if table.sizeHintForIndex(index).width() > room:
                    yield f"cell {index.data()!r} of column {title!r}"


def _is_header_cut(header: QHeaderView, column: int) -> bool:
    text = str(header.model().headerData(column, header.orientation()) or "")
    return _width_of(text, header) + 4 > header.sectionSize(column)


def _do_scale_texts_overlap(scale: SliderScale) -> bool:
    ends, names = scale.place_texts(QFontMetricsF(scale.text_font()))
    boxes = [box for _, box in (*ends, *names)]
    bounds = scale.rect().toRectF().adjusted(-1, 0, 1, 3)
    return any(one.intersects(other) for one, other in combinations(boxes, 2)) or any(
        not bounds.contains(box) for box in boxes
    )


_CUT: dict[type[QWidget], Callable[[Any], bool]] = {
    QLabel: _is_label_cut,
    QLineEdit: _is_field_cut,
    QAbstractSpinBox: _is_spin_box_cut,
    QComboBox: _is_choice_cut,
    QAbstractButton: _is_button_cut,
    QTabBar: _is_tab_bar_cut,
    QSlider: lambda slider: slider.width() < SHORTEST_SLIDER,
    SliderScale: _do_scale_texts_overlap,
}


def find_cut_texts(window: QWidget) -> list[str]:
    """Describe the texts that are not shown whole, and the sliders that are too short."""
    faults = []
    for control in visible_controls(window):
        if control.visibleRegion().isEmpty():  # scrolled out of sight
            continue
        for kind, is_cut in _CUT.items():
            if isinstance(control, kind) and is_cut(control):
                faults.append(f"cut: {describe(control)}")
        if isinstance(control, QTableView):
            faults += [f"cut: {cell} of {describe(control)}" for cell in _list_cut_cells(control)]
    return sorted(faults)


def describe(control: QWidget) -> str:
    text = getattr(control, "text", str)
    name = control.accessibleName() or (text() if not isinstance(control, QTabBar) else "")
    place = QRect(control.mapTo(control.window(), QRect().topLeft()), control.size())
    dock = control.parentWidget()
    while dock is not None and not isinstance(dock, QDockWidget):
        dock = dock.parentWidget()
    pane = dock.objectName() if dock is not None else ""
    shown = f", {control._full!r}" if isinstance(control, ElidedLabel) else ""
    return (
        f"{type(control).__name__} {name!r}{shown} in {pane!r} at {place.x()}, {place.y()}, "
        f"{place.width()} x {place.height()}"
    )


def find_faults(window: QWidget) -> list[str]:
    controls = visible_controls(window)
    texts = [f"too small: {describe(control)}" for control in controls if is_too_small(control)]
    texts += [f"cut off: {describe(control)}" for control in controls if is_cut_off(control)]
    children = defaultdict[QWidget | None, list[QWidget]](list)
    for control in controls:
        children[control.parentWidget()].append(control)
    texts += [
        f"overlapping: {describe(one)} and {describe(other)}"
        for siblings in children.values()
        for one, other in combinations(siblings, 2)
        if one.geometry().intersects(other.geometry())
    ]
    return texts


def find_cut_axis_labels(window: QWidget) -> list[str]:
    labels = [
        (plot, plot.getAxis(side).label)
        for plot in window.findChildren(pg.PlotWidget)
        if plot.isVisible() and not is_behind(plot)
        for side in ("left", "bottom")
    ]
    return [
        label.toPlainText()
        for plot, label in labels
        if label.isVisible()
        and not plot.rect().toRectF().adjusted(-6, -6, 6, 6).contains(label.sceneBoundingRect())
    ]
