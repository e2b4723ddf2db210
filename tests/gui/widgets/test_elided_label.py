"""A text that is too long is shortened by dots, and whole in the tooltip."""

import pytest
from gui.kinds import show_widget
from pytestqt.qtbot import QtBot

from occ_gui.widgets.elided_label import ElidedLabel
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
