"""A pane that is made when it is first seen."""

from collections.abc import Callable
from typing import TypeAlias

from PySide6.QtWidgets import QVBoxLayout, QWidget

from occ_gui.widgets.event_filters import leave_drops_to_window

PaneContent: TypeAlias = tuple[QWidget, Callable[[bool], None]]
"""What a pane shows, and whom to tell whether it can be seen."""


class LazyPane(QWidget):
    """Holds a pane's place until somebody looks there: the window opens so much sooner.

    Parameters
    ----------
    make
        Makes what the pane shows.
    parent
        The parent widget.
    """

    def __init__(self, make: Callable[[], PaneContent], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._make = make
        self._tell: Callable[[bool], None] | None = None
        self._place = QVBoxLayout(self)
        self._place.setContentsMargins(0, 0, 0, 0)

    def set_seen(self, seen: bool) -> None:
        """Say whether anybody can see the pane."""
        if seen and self._tell is None:
            content, self._tell = self._make()
            self._place.addWidget(content)
            leave_drops_to_window(self)
        if self._tell is not None:
            self._tell(seen)
