"""Make, name, fit and lay out widgets: labels, sizes of text, boxes of choices, scrolling panes."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias, TypeVar

from PySide6.QtCore import QEvent, QObject, QSize, Qt, Signal, SignalInstance
from PySide6.QtGui import QFont, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QBoxLayout,
    QCheckBox,
    QComboBox,
    QFrame,
    QLabel,
    QLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QTableView,
    QTabWidget,
    QWidget,
)

from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_gui.widgets.plain_text import LONGEST_TEXT, in_tool_tip
from occ_model.errors import one_line

Label = TypeVar("Label", bound=QLabel)


_FONT_DECIMALS = 6  # to which sizes in points are rounded, so that a change can be reversed

_HEADING = 16 / 13  # size of a heading relative to text: 16 pixels if text has 13


def resize_font(font: QFont, factor: float) -> QFont:
    new_font = QFont(font)
    if font.pointSizeF() > 0.0:
        new_font.setPointSizeF(round(factor * font.pointSizeF(), _FONT_DECIMALS))
    else:  # a font whose size is given in pixels
        new_font.setPixelSize(round(factor * font.pixelSize()))
    return new_font


def heading_font(font: QFont) -> QFont:
    new_font = resize_font(font, _HEADING)
    new_font.setBold(True)
    return new_font


def embolden(label: Label, factor: float = 1.0) -> Label:
    """Make the text of a label bold, and change its size by a factor; return the label."""
    font = label.font()
    font.setBold(True)
    if factor != 1.0:  # a label with a size of its own does not follow the application's size
        font = resize_font(font, factor)
    label.setFont(font)
    return label


class ElidedLabel(QLabel):
    """Shows as much of a text as fits, and the whole text in the tooltip.

    ``separator``: what stands between the parts of the text, which are shown whole or not at all;
    without it, the text is cut anywhere.
    """

    def __init__(
        self,
        text: str = "",
        *,
        how: Qt.TextElideMode = Qt.TextElideMode.ElideRight,
        separator: str = "",
    ) -> None:
        super().__init__()
        self._how, self._separator = how, separator
        self._full = ""
        self._last_fit: tuple[str, int] | None = None
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.set_full_text(text)

    def set_full_text(self, text: str) -> None:
        full = one_line(text, LONGEST_TEXT)
        if full != self._full:
            self._full = full
            self.setToolTip(in_tool_tip(full))
        self._fit()

    def _fit(self) -> None:
        fit = (self._full, self.contentsRect().width())
        if fit != self._last_fit:  # avoids laying out the surrounding widgets again
            self._last_fit = fit
            text, metrics, separator = self._full, self.fontMetrics(), self._separator
            while separator and separator in text and metrics.horizontalAdvance(text) > fit[1]:
                text = text.rpartition(separator)[0]
            self.setText(metrics.elidedText(text, self._how, fit[1]))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_how"):
            self._last_fit = None
            self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._fit()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a width of zero: the label can be narrower than its text."""
        return QSize(0, super().minimumSizeHint().height())


class ScrollPane(QScrollArea):
    """Shows a widget that is as wide as the pane, and as high as it needs to be."""

    def __init__(self, content: QWidget | None = None, least: QSize | None = None) -> None:
        super().__init__()
        self._least = least or QSize()
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        if content is not None:
            self.setWidget(content)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        handled = super().eventFilter(watched, event)
        if event.type() == QEvent.Type.LayoutRequest and watched is self.widget():
            self.updateGeometry()
        return handled

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the least size, no narrower than the content, which only scrolls vertically."""
        content = self.widget()
        if content is None:
            return self._least
        needed, bar = content.minimumSizeHint(), self.verticalScrollBar().sizeHint().width()
        width = max(self._least.width(), needed.width() + bar)
        return QSize(width, min(self._least.height(), needed.height()))


def bring_into_view(widget: QWidget, margin: int = 50) -> None:
    """Select the tabs and scroll the areas that contain a widget, so that it is visible."""
    areas: list[QScrollArea] = []
    page, ancestor = widget, widget.parentWidget()
    while ancestor is not None:
        tabs = ancestor.parentWidget()
        if isinstance(ancestor, QScrollArea):
            areas.append(ancestor)
        elif isinstance(tabs, QTabWidget):
            tabs.setCurrentWidget(page)
        page, ancestor = ancestor, tabs
    for area in areas:  # now that pages brought to the front have been laid out
        area.ensureWidgetVisible(widget, 0, margin)


_POPUP_MARGIN = 36  # pixels for margins and scroll bar of the list


class KeyedComboBox(QComboBox):
    """A combo box that emits the key of the chosen word; if fixed, it is as wide as its words."""

    chosen = Signal(str)

    def __init__(
        self, name: str, meaning: str, words: Mapping[str, str], *, is_fixed: bool = False
    ) -> None:
        super().__init__()
        for key, word in words.items():
            self.addItem(word, key)
        self.setAccessibleName(name)
        self.setToolTip(meaning)
        policy, adjust = QSizePolicy.Policy, QComboBox.SizeAdjustPolicy
        self.setSizePolicy(policy.Fixed if is_fixed else policy.Expanding, policy.Fixed)
        self.setSizeAdjustPolicy(
            adjust.AdjustToContents if is_fixed else adjust.AdjustToMinimumContentsLengthWithIcon
        )
        keep_wheel_for_scrolling(self)
        self.activated.connect(lambda: self.chosen.emit(self.key()))

    def showPopup(self) -> None:  # noqa: N802 - Qt's name
        """Open the list as wide as its widest word, even if the box is narrower."""
        words = (self.itemText(place) for place in range(self.count()))
        widest = max(map(self.fontMetrics().horizontalAdvance, words), default=0)
        self.view().setMinimumWidth(widest + _POPUP_MARGIN)
        super().showPopup()

    def key(self) -> str:
        return str(self.currentData())

    def show_key(self, key: str) -> None:
        self.setCurrentIndex(self.findData(key))


Box = TypeVar("Box", bound=QBoxLayout)
Part: TypeAlias = QWidget | QLayout | int | tuple[Any, ...] | None
"""A widget or a layout, or a tuple of it with its stretch and alignment; an integer for pixels of
space; None for a stretch."""


def fill(
    layout: Box,
    *parts: Part,
    margins: int | tuple[int, int, int, int] | None = None,
    spacing: int | None = None,
) -> Box:
    """Fill a layout, and return it; margins and spacing default to those of the style."""
    if margins is not None:
        left, top, right, bottom = (margins,) * 4 if isinstance(margins, int) else margins
        layout.setContentsMargins(left, top, right, bottom)
    if spacing is not None:
        layout.setSpacing(spacing)
    for part in parts:
        item, *options = part if isinstance(part, tuple) else (part,)
        if item is None:
            layout.addStretch(*options)
        elif isinstance(item, int):
            layout.addSpacing(item)
        elif isinstance(item, QLayout):
            layout.addLayout(item, *options)
        else:
            layout.addWidget(item, *options)
    return layout


Widget = TypeVar("Widget", bound=QWidget)
Table = TypeVar("Table", bound=QTableView)


def name_widget(widget: Widget, name: str, tip: str = "") -> Widget:
    widget.setAccessibleName(name)
    if tip:
        widget.setToolTip(tip)
    return widget


def push_button(
    text: str = "",
    tip: str = "",
    do: Callable[..., object] | SignalInstance | None = None,
    *,
    name: str = "",
) -> QPushButton:
    """Make a button; without ``name``, screen readers get its text."""
    button = name_widget(QPushButton(text), name, tip)
    if do is not None:
        button.clicked.connect(do)
    return button


def check_box(
    text: str, tip: str = "", do: Callable[..., object] | SignalInstance | None = None
) -> QCheckBox:
    """Make a check box; ``do`` is called at every change, even by the program."""
    button = QCheckBox(text)
    button.setToolTip(tip)
    if do is not None:
        button.toggled.connect(do)
    return button


def make_read_only(table: Table, name: str, tip: str = "") -> Table:
    """Make a table read-only: it selects whole rows, and the Tab key leaves it."""
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.verticalHeader().hide()
    table.setTabKeyNavigation(False)
    return name_widget(table, name, tip)


def paragraph(text: str = "", *, name: str = "", is_selectable: bool = False) -> QLabel:
    label = name_widget(QLabel(text, wordWrap=True, textFormat=Qt.TextFormat.PlainText), name)
    if is_selectable:
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label
