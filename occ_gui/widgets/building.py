"""Functions that fill a layout, or make and name a widget, in one call."""

from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

from PySide6.QtCore import Qt, SignalInstance
from PySide6.QtWidgets import (
    QAbstractItemView,
    QBoxLayout,
    QCheckBox,
    QLabel,
    QLayout,
    QPushButton,
    QTableView,
    QWidget,
)

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
        what, *how = part if isinstance(part, tuple) else (part,)
        if what is None:
            layout.addStretch(*how)
        elif isinstance(what, int):
            layout.addSpacing(what)
        elif isinstance(what, QLayout):
            layout.addLayout(what, *how)
        else:
            layout.addWidget(what, *how)
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
    made = name_widget(QPushButton(text), name, tip)
    if do is not None:
        made.clicked.connect(do)
    return made


def check_box(
    text: str, tip: str = "", do: Callable[..., object] | SignalInstance | None = None
) -> QCheckBox:
    """Make a check box; ``do`` is called at every change, also by the program."""
    made = QCheckBox(text)
    made.setToolTip(tip)
    if do is not None:
        made.toggled.connect(do)
    return made


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
