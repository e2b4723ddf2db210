"""Parameter page: a page of controls, which are made when they are first seen or asked for."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QFrame, QScrollArea

from occ_gui.scene.parameter_panel import ParameterPanel
from occ_gui.widgets.event_filters import leave_drops_to_window

_BAR = 20  # pixels that the scroll bar takes at most


class ParameterPage(QScrollArea):
    """A page with the controls of some parameters; by default without headings."""

    made = Signal(object)  # its controls have been made: the ParameterPanel

    def __init__(
        self, names: Sequence[str], make: Callable[[], ParameterPanel] | None = None
    ) -> None:
        super().__init__()
        self.names = names
        self.content: ParameterPanel | None = None
        self._make = make or (lambda: ParameterPanel(names))
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)

    def panel(self) -> ParameterPanel:
        if self.content is None:
            self.content = self._make()
            self.setWidget(self.content)
            self.setMinimumWidth(self.content.minimumSizeHint().width() + _BAR)
            leave_drops_to_window(self)
            self.made.emit(self.content)
        return self.content

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        self.panel()
        super().showEvent(event)
