"""Layouts that are filled in one call."""

from typing import Any, TypeAlias, TypeVar

from PySide6.QtWidgets import QBoxLayout, QLayout, QWidget

Box = TypeVar("Box", bound=QBoxLayout)
Part: TypeAlias = QWidget | QLayout | int | tuple[Any, ...] | None
"""A widget or a layout, also with its stretch and alignment; pixels of space; None: a stretch."""


def filled(
    layout: Box,
    *parts: Part,
    margins: int | tuple[int, int, int, int] | None = None,
    spacing: int | None = None,
) -> Box:
    """Fill a layout; margins and spacing that are not given are those of the style."""
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
