"""Widgets made in one call, with what a screen reader and the pointer tell of them."""

from collections.abc import Callable
from typing import TypeVar

from PySide6.QtCore import Qt, SignalInstance
from PySide6.QtWidgets import QLabel, QPushButton, QWidget

Widget = TypeVar("Widget", bound=QWidget)


def named(widget: Widget, name: str, tip: str = "") -> Widget:
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
    """Make a button; without a name of its own Qt gives screen readers its present text."""
    made = named(QPushButton(text), name, tip)
    if do is not None:
        made.clicked.connect(do)
    return made


def paragraph(text: str = "", *, name: str = "", is_selectable: bool = False) -> QLabel:
    """Make a label of plain text, wrapped where it is too long for one line."""
    label = named(QLabel(text, wordWrap=True, textFormat=Qt.TextFormat.PlainText), name)
    if is_selectable:
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label
