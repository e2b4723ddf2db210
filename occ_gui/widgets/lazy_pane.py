"""Lazy pane: a pane whose content is created when it is first shown."""

from collections.abc import Callable
from typing import TypeAlias

from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.widgets.event_filters import leave_drops_to_window

PaneContent: TypeAlias = tuple[QWidget, Callable[[bool], None]]
"""The widget of a pane, and a function that receives whether the pane is visible."""


class LazyPane(QWidget):
    """An empty widget until it is first shown, which makes the window open faster.

    Parameters
    ----------
    make
        Creates the content.
    parent
        The parent widget.
    """

    def __init__(self, make: Callable[[], PaneContent], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._make = make
        self._set_visible: Callable[[bool], None] | None = None
        self._place = QVBoxLayout(self)
        self._place.setContentsMargins(0, 0, 0, 0)

    def set_seen(self, seen: bool) -> None:
        """Set whether the pane is visible."""
        if seen and self._set_visible is None:
            content, self._set_visible = self._make()
            self._place.addWidget(content)
            leave_drops_to_window(self)
        if self._set_visible is not None:
            self._set_visible(seen)
