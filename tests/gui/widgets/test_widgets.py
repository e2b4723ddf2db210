"""Small widgets: labels, scroll panes and combo boxes, and the comparison of drawn values."""

from collections.abc import Iterator

import numpy as np
import pytest
from gui.kinds import show_widget
from PySide6.QtCore import QSize
from PySide6.QtWidgets import QApplication, QLabel, QTabWidget, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.widgets.building import (
    ElidedLabel,
    KeyedComboBox,
    ScrollPane,
    bring_into_view,
    embolden,
    fill,
    resize_font,
)
from occ_gui.widgets.guarded_paint import are_equal
from occ_gui.widgets.plain_text import in_tool_tip

LONG = "Photo a_name_that_goes_on_and_on_<b>and</b>_on_until_it_ends.png"


@pytest.fixture
def label(qtbot: QtBot) -> ElidedLabel:
    return show_widget(qtbot, ElidedLabel(LONG))


@pytest.mark.parametrize("width", [40, 120, 300])
def test_a_text_too_long_is_shown_in_part_and_never_cut_off(label: ElidedLabel, width: int) -> None:
    label.resize(width, 20)
    assert label.text() != LONG
    assert "…" in label.text()
    for factor in (1.0, 2.0):
        label.setFont(resize_font(label.font(), factor))
        assert label.fontMetrics().horizontalAdvance(label.text()) <= width


def test_a_text_that_fits_is_shown_whole_and_literally(label: ElidedLabel) -> None:
    label.resize(40, 20)
    label.resize(900, 20)
    assert label.text() == LONG
    assert label.sizeHint().width() > label.fontMetrics().horizontalAdvance(LONG[:-5])


def test_the_tooltip_tells_the_whole_text_which_asks_for_no_width(label: ElidedLabel) -> None:
    label.resize(40, 20)
    assert label.toolTip() == in_tool_tip(LONG)
    assert label.minimumSizeHint().width() == 0
    label.set_full_text("short")
    assert (label.text(), label.toolTip()) == ("short", "short")


def test_a_choice_is_as_wide_as_its_place_or_where_it_is_fixed_as_its_words(qtbot: QtBot) -> None:
    column = show_widget(qtbot, QWidget(), 400, 100)
    wide, fixed = (
        KeyedComboBox("Size", "", {"s": "small"}, **how) for how in ({}, {"is_fixed": True})
    )
    fill(QVBoxLayout(column), wide, fixed, margins=0)
    QApplication.processEvents()
    assert (wide.width(), fixed.width()) == (400, fixed.sizeHint().width())


@pytest.fixture
def same_font_after(qapp: QApplication) -> Iterator[None]:
    font = qapp.font()
    yield
    qapp.setFont(font)


def test_a_label_in_bold_alone_follows_the_applications_size(
    qtbot: QtBot, qapp: QApplication, same_font_after: None
) -> None:
    label, larger = (show_widget(qtbot, embolden(QLabel(), factor)) for factor in (1.0, 1.25))
    usual = qapp.font().pointSizeF()
    assert larger.font().pointSizeF() == pytest.approx(1.25 * usual)
    font = qapp.font()
    font.setPointSizeF(2.0 * usual)
    qapp.setFont(font)
    qapp.processEvents()  # Qt tells its windows of another font by an event
    assert label.font().bold()
    assert label.font().pointSizeF() == pytest.approx(2.0 * usual)


ARRAY = np.array([1.0, 2.0])


@pytest.mark.parametrize(
    ("ones", "others", "same"),
    [
        ([], [], True),
        ([1, "a"], [1, "a"], True),
        ([1, "a"], [1, "b"], False),
        ([1], [1, 2], False),
        ([ARRAY, 1], [ARRAY.copy(), 1], True),
        ([ARRAY], [ARRAY + 1.0], False),
        ([ARRAY], [ARRAY[:1]], False),
        ([ARRAY], [1.0], False),
    ],
)
def test_lists_are_the_same_where_every_value_is(
    ones: list[object], others: list[object], same: bool
) -> None:
    assert are_equal(ones, others) is same


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
