"""Panels of the pane: side by side or one over the other as the space allows, or behind tabs.

A QSplitter can neither turn as its size changes nor hide panels behind tabs.
"""

from dataclasses import dataclass

from PySide6.QtCore import QRect, QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QTabBar, QWidget

_GAP = 8

_TALL_HEIGHT = 440  # height in pixels from which panels stand one over the other
_TWO_COLUMNS_WIDTH = 1100  # width in pixels from which a high pane has two columns
_TOP_FRACTION = 0.56  # largest part of the height for the upper panel


@dataclass(frozen=True, slots=True)
class Panel:
    title: str
    widget: QWidget
    width: int  # the width in pixels that it needs beside others
    weight: int  # weight of its share of the spare width


class Panels(QWidget):
    """A main panel, and two that divide the remaining space or share it behind tabs."""

    def __init__(self, main: Panel, second: Panel, third: Panel) -> None:
        super().__init__()
        self._panels = (main, second, third)
        self._in_tabs: tuple[Panel, ...] = ()
        self._chosen = main
        for panel in self._panels:
            panel.widget.setParent(self)
        self.tabs = QTabBar(drawBase=False, expanding=False, usesScrollButtons=False)
        self.tabs.currentChanged.connect(self._choose)
        self._show_tabs(self._panels)

    def show_panel(self, widget: QWidget) -> None:
        for place, panel in enumerate(self._in_tabs):
            if panel.widget is widget:
                self.tabs.setCurrentIndex(place)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size of the largest panel, behind which the others can hide."""
        sizes = [panel.widget.minimumSizeHint() for panel in self._panels]
        return QSize(max(s.width() for s in sizes), max(s.height() for s in sizes))

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return self.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._arrange()

    def _choose(self, tab: int) -> None:
        if tab >= 0:
            self._chosen = self._in_tabs[tab]
            self._arrange()

    def _arrange(self) -> None:
        main, second, third = self._panels
        area = self.rect()
        if area.height() < _TALL_HEIGHT:
            count = next((n for n in (3, 2) if self._have_room(*self._panels[:n])), 1)
            self._show_tabs(() if count == 3 else self._panels[count - 1 :])
            places = self._divide_width(area, *self._panels[: count - 1], self._pick_panel(third))
        elif area.width() >= _TWO_COLUMNS_WIDTH:
            self._show_tabs(())
            left, right = self._divide_width(area, main, second).values()
            top, bottom = self._divide_height(left)
            places = {main: top, second: right, third: bottom}
        else:
            have_room = self._have_room(second, third)
            self._show_tabs(() if have_room else (second, third))
            top, bottom = self._divide_height(area)
            lower = (second, third) if have_room else (self._pick_panel(third),)
            places = {main: top, **self._divide_width(bottom, *lower)}
        for panel in self._panels:
            panel.widget.setVisible(panel in places)
            if panel in places:
                panel.widget.setGeometry(places[panel])

    def _pick_panel(self, default: Panel) -> Panel:
        return self._chosen if self._in_tabs else default

    def _have_room(self, *panels: Panel) -> bool:
        return sum(panel.width for panel in panels) + (len(panels) - 1) * _GAP <= self.width()

    def _show_tabs(self, panels: tuple[Panel, ...]) -> None:
        if panels == self._in_tabs:
            return
        self._in_tabs = panels
        self.tabs.blockSignals(True)
        while self.tabs.count():
            self.tabs.removeTab(0)
        for panel in panels:
            self.tabs.addTab(panel.title)
        if panels:
            self._chosen = self._chosen if self._chosen in panels else panels[0]
            self.tabs.setCurrentIndex(panels.index(self._chosen))
        self.tabs.blockSignals(False)
        self.tabs.setVisible(bool(panels))

    def _divide_width(self, area: QRect, *panels: Panel) -> dict[Panel, QRect]:
        spare = area.width() - sum(p.width for p in panels) - (len(panels) - 1) * _GAP
        weights = sum(panel.weight for panel in panels)
        places, left = {}, area.left()
        for panel in panels:
            share = spare * panel.weight // weights
            places[panel] = QRect(left, area.top(), panel.width + share, area.height())
            left += panel.width + share + _GAP
            spare, weights = spare - share, weights - panel.weight
        return places

    def _divide_height(self, area: QRect) -> tuple[QRect, QRect]:
        """Divide an area between the main panel and those below it."""
        height = self._panels[0].widget.sizeHint().height()
        height = min(height, int(_TOP_FRACTION * area.height()))
        top = QRect(area.left(), area.top(), area.width(), height)
        below = area.adjusted(0, height + _GAP, 0, 0)
        return top, below
