"""Kinds of what many tests of the window are given, and widgets that close with their test."""

from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from occ_gui.simulation.snapshot import Snapshot

Grey: TypeAlias = NDArray[np.uint8]
GreyPicture: TypeAlias = Callable[[QWidget], Grey]
SnapshotOf: TypeAlias = Callable[..., Snapshot]

T = TypeVar("T")
Widget = TypeVar("Widget", bound=QWidget)


def add_widget(qtbot: QtBot, widget: Widget) -> Widget:
    """Let a widget be closed at the end of the test."""
    qtbot.addWidget(widget)
    return widget


def show_widget(qtbot: QtBot, widget: Widget, width: int = 0, height: int = 0) -> Widget:
    """Show a widget, in its own size or in this one."""
    add_widget(qtbot, widget)
    if width:
        widget.resize(width, height)
    widget.show()
    return widget


def not_none(value: T | None) -> T:
    """Take for granted that there is something."""
    assert value is not None
    return value


def collect(signal: Any) -> list[Any]:
    """Return the list in which a signal's values will stand, one after the other."""
    values: list[Any] = []
    signal.connect(values.append)
    return values
