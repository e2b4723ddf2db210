"""The strip of chips read from a photo: under its columns, told in words, and copied."""

import numpy as np
import pytest
from gui.kinds import collect, show_widget
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from occ_gui.profile.profile_view import ProfileView
from occ_gui.values.photo_results import PhotoProfile
from occ_model.results.decoding import Region
from occ_model.results.match import ChipReading

CHIPS = np.array([1, 0, 1, 1, 0], np.uint8)


def reading(confidence: float = 0.99) -> ChipReading:
    return ChipReading(CHIPS, 10.0, confidence, 5.0, Region(0, 9, 0, 60))


@pytest.fixture
def view(qtbot: QtBot) -> ProfileView:
    view = show_widget(qtbot, ProfileView(), 700, 400)
    view.chips.show_chips(reading())
    view.plot.setXRange(0.0, 100.0, padding=0.0)
    qtbot.waitExposed(view)
    return view


def edges(view: ProfileView) -> list[float]:
    """Columns of the plot at which the cells begin, and the end of the last one."""
    (low, high), cells = view.plot.viewRange()[0], view.chips.cells
    box = view.plot.getViewBox().sceneBoundingRect()
    found = cells.rectangles()
    ends = [one.left() for _, one in found] + [found[-1][1].right()]
    left = cells.mapFrom(view, view.plot.mapTo(view, view.plot.rect().topLeft())).x()
    return [(end - left - box.left()) / box.width() * (high - low) + low for end in ends]


def test_each_chip_in_view_lies_under_its_columns_also_where_the_photo_is_moved(
    view: ProfileView,
) -> None:
    cells = view.chips.cells
    assert [chip for chip, _ in cells.rectangles()] == CHIPS.tolist()
    assert edges(view) == pytest.approx([5, 15, 25, 35, 45, 55], abs=0.5)
    view.plot.setXRange(26.0, 44.0, padding=0.0)
    assert [chip for chip, _ in cells.rectangles()] == [1, 1]
    view.show_photo_profile(PhotoProfile(None, np.full(60, 50.0), 20.0, 0.5))
    view.plot.setXRange(0.0, 100.0, padding=0.0)
    assert edges(view) == pytest.approx([22.5, 27.5, 32.5, 37.5, 42.5, 47.5], abs=0.5)
    axis = view.plot.getAxis("left").width()
    assert view.chips.copy.width() == pytest.approx(axis, abs=1) == cells.x()


def test_chips_are_copied_as_text_and_told_in_words(view: ProfileView, qtbot: QtBot) -> None:
    said = collect(view.chips.copied)
    qtbot.mouseClick(view.chips.copy, Qt.MouseButton.LeftButton)
    assert QGuiApplication.clipboard().text() == "10110"
    assert said == ["Copied: 10110"]
    cells = view.chips.cells
    assert cells.toolTip() == (
        "5 chips read from the photo, 10.00 columns each; all of them are right with a "
        "probability of 99 %"
    )
    assert cells.accessibleDescription().endswith(": 10110")
    assert view.chips.isVisible()
    view.chips.show_chips(None)
    assert not view.chips.isVisible()


def test_uncertain_chips_are_drawn_faintly(view: ProfileView) -> None:
    certain = view.chips.cells.grab().toImage()
    view.chips.show_chips(reading(0.6))
    uncertain = view.chips.cells.grab().toImage()
    place = view.chips.cells.rectangles()[0][1].center().toPoint()
    place.setY(3)
    assert certain.pixelColor(place).lightness() < uncertain.pixelColor(place).lightness()
