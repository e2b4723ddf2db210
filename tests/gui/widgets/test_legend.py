"""A legend tells lines apart by their kind as well as their colour."""

import pytest
from gui.kinds import GreyPicture, add_widget
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPen
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_gui.widgets.legend import LineLegend, Sample


@pytest.fixture
def legend(qtbot: QtBot) -> LineLegend:
    legend = add_widget(qtbot, LineLegend())
    legend.add_line("solid", QPen(QColor("black")), "a solid line")
    legend.add_line("dashed", QPen(QColor("black"), 1, Qt.PenStyle.DashLine), "a dashed line")
    legend.show()
    return legend


def visible_texts(legend: LineLegend) -> list[str]:
    labels = legend.findChildren(QLabel)
    return [label.text() for label in labels if label.isVisible() and label.text()]


def test_an_entry_is_shown_or_hidden_by_its_key(legend: LineLegend) -> None:
    legend.show_line("solid", True)
    legend.show_line("dashed", False)
    assert visible_texts(legend) == ["a solid line"]
    legend.show_line("dashed", True)
    assert visible_texts(legend) == ["a solid line", "a dashed line"]


def test_samples_of_one_colour_differ_by_their_dashes(
    legend: LineLegend, grey_picture: GreyPicture
) -> None:
    for key in ("solid", "dashed"):
        legend.show_line(key, True)
    samples = legend.findChildren(Sample)
    solid, dashed = (int((grey_picture(sample) < 100).sum()) for sample in samples)
    assert 0 < dashed < solid
