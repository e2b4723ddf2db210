"""A plot shows the name of its lower axis only if it is high enough."""

import pytest
from PySide6.QtGui import QPalette
from pytestqt.qtbot import QtBot

from occ_gui.widgets.plot import Plot, new_plot


@pytest.fixture
def plot(qtbot: QtBot) -> Plot:
    plot = new_plot("Test", "column", "level", QPalette())
    plot.setMinimumHeight(20)
    qtbot.addWidget(plot)
    plot.show()
    return plot


def is_named(plot: Plot) -> bool:
    return bool(plot.getAxis("bottom").label.isVisible())


def test_a_low_plot_leaves_the_name_out_and_a_high_one_has_it(plot: Plot) -> None:
    for height, named in ((200, True), (60, False), (100, True)):
        plot.resize(300, height)
        assert is_named(plot) == named


def test_a_name_that_is_not_wanted_is_left_out_at_every_height(plot: Plot) -> None:
    plot.resize(300, 200)
    plot.name_bottom(False)
    assert not is_named(plot)
    for height in (60, 200):
        plot.resize(300, height)
        assert not is_named(plot)
    plot.name_bottom(True)
    assert is_named(plot)
