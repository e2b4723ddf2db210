"""Panels side by side, as many as fit; the others are chosen by tabs."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QTabBar, QWidget

_GAP = 8


@dataclass(frozen=True, slots=True)
class Panel:
    """A panel.

    Parameters
    ----------
    title
        Its title, for a tab.
    widget
        The panel.
    width
        The width in pixels that it needs beside others.
    weight
        Its share of the width that is left over.
    """

    title: str
    widget: QWidget
    width: int
    weight: int


class SidePanels(QWidget):
    """Shows the first panels side by side, and one of the rest in the last place.

    Parameters
    ----------
    panels
        The panels, the most important first.
    parent
        The parent widget.
    """

    def __init__(self, panels: Sequence[Panel], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._panels = tuple(panels)
        self._beside = 0
        self._chosen = 0
        for panel in panels:
            panel.widget.setParent(self)
        self.tabs = QTabBar()
        self.tabs.setDrawBase(False)
        self.tabs.setExpanding(False)
        self.tabs.setUsesScrollButtons(False)
        self.tabs.currentChanged.connect(self._choose)
        self._offer(0)

    def show_panel(self, widget: QWidget) -> None:
        """Bring a panel into view."""
        for place, panel in enumerate(self._panels):
            if panel.widget is widget and place >= self._beside and self.tabs.count():
                self.tabs.setCurrentIndex(place - self._beside)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size of the largest panel: the others can hide behind it."""
        sizes = [panel.widget.minimumSizeHint() for panel in self._panels]
        return QSize(max(s.width() for s in sizes), max(s.height() for s in sizes))

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the same size."""
        return self.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Show as many panels as fit."""
        super().resizeEvent(event)
        self._arrange()

    def _choose(self, tab: int) -> None:
        if tab >= 0:
            self._chosen = self._beside + tab
            self._arrange()

    def _arrange(self) -> None:
        width, beside = self.width(), 0
        for count in range(len(self._panels), 1, -1):
            if sum(p.width for p in self._panels[:count]) + (count - 1) * _GAP <= width:
                beside = count if count == len(self._panels) else count - 1
                break
        if beside != self._beside or self.tabs.count() != self._tab_count(beside):
            self._offer(beside)
        shown = list(self._panels[:beside])
        if beside < len(self._panels):
            shown.append(self._panels[max(self._chosen, beside)])
        for panel in self._panels:
            panel.widget.setVisible(panel in shown)
        self._place(shown)

    def _tab_count(self, beside: int) -> int:
        return len(self._panels) - beside

    def _offer(self, beside: int) -> None:
        """Offer the panels that are not side by side, by tabs."""
        self._beside = beside
        self.tabs.blockSignals(True)
        while self.tabs.count():
            self.tabs.removeTab(0)
        for panel in self._panels[beside:]:
            self.tabs.addTab(panel.title)
        self._chosen = max(self._chosen, beside)
        if self.tabs.count():
            self.tabs.setCurrentIndex(self._chosen - beside)
        self.tabs.blockSignals(False)
        self.tabs.setVisible(self.tabs.count() > 1)

    def _place(self, shown: Sequence[Panel]) -> None:
        spare = self.width() - sum(p.width for p in shown) - (len(shown) - 1) * _GAP
        weights = sum(panel.weight for panel in shown)
        left = 0
        for panel in shown:
            width = panel.width + spare * panel.weight // max(weights, 1)
            if panel is shown[-1]:
                width = self.width() - left
            panel.widget.setGeometry(left, 0, width, self.height())
            left += width + _GAP
