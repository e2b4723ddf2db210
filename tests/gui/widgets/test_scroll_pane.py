"""A pane that is lower than its content scrolls, and is no higher than it is given."""

import pytest
from gui.kinds import show_widget
from PySide6.QtCore import QSize
from PySide6.QtWidgets import QLabel, QTabWidget, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.widgets.scroll_pane import ScrollPane, bring_into_view


@pytest.mark.parametrize(("height", "asked"), [(500, 120), (70, 70)])
def test_the_pane_asks_for_its_contents_size_up_to_its_limit(
    qtbot: QtBot, height: int, asked: int
) -> None:
    content = QWidget()
    layout = QVBoxLayout(content)
    layout.setContentsMargins(0, 0, 0, 0)
    label = QLabel("text")
    label.setMinimumHeight(height)
    layout.addWidget(label)
    pane = show_widget(qtbot, ScrollPane(content, QSize(200, 120)), 200, 120)
    assert pane.minimumSizeHint() == QSize(200, asked)
    assert pane.verticalScrollBar().isVisible() == (height > 120)
    assert not pane.horizontalScrollBar().isVisible()


def test_a_widget_is_brought_into_view_from_a_page_that_was_never_in_front(qtbot: QtBot) -> None:
    pages, last = QTabWidget(), QLabel()
    for name in ("first", "second"):
        content = QWidget()
        layout = QVBoxLayout(content)
        for place in range(60):
            last = QLabel(f"{name} {place}")
            layout.addWidget(last)
        pages.addTab(ScrollPane(content, QSize(200, 120)), name)
    show_widget(qtbot, pages, 300, 300)
    bring_into_view(last)
    assert pages.currentIndex() == 1
    assert not last.visibleRegion().isEmpty()
