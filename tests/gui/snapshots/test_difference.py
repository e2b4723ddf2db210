"""The comparison of pictures sees what an eye sees, and lets pass what only a system draws."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import SnapshotOf
from gui.snapshots.drawing import Colours, difference, settled, show
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from occ_gui.decoding.decode_view import DecodeView
from occ_gui.profile.profile_view import ProfileView


@pytest.fixture
def profile(qtbot: QtBot, snapshot_of: SnapshotOf) -> ProfileView:
    view = ProfileView()
    show(qtbot, view, 560, 260)
    view.show_reading(snapshot_of())
    return view


@pytest.fixture
def decode(qtbot: QtBot, snapshot_of: SnapshotOf) -> DecodeView:
    view = DecodeView()
    show(qtbot, view, 380, 560)
    view.show_reading(snapshot_of())
    return view


def pixel(plot: pg.PlotWidget) -> tuple[float, float]:
    """Return the width and height of a pixel in the plot's units."""
    width, height = plot.getViewBox().viewPixelSize()
    return width, height


def shift_threshold(view: DecodeView) -> None:
    line = view.signal.threshold
    line.setValue(line.value() + pixel(view.signal.plot)[1])


CHANGES: dict[str, tuple[str, Callable[[Any], object]]] = {
    "curve aside": ("profile", lambda v: v.simulation.setPos(pixel(v.plot)[0], 0)),
    "curve up": ("profile", lambda v: v.simulation.setPos(0, pixel(v.plot)[1])),
    "dashed curve aside": ("profile", lambda v: v.band.setPos(pixel(v.plot)[0], 0)),
    "colour": ("profile", lambda v: v.simulation.setPen(pg.mkPen("#009e73"))),
    "no curve": ("profile", lambda v: v.band.hide()),
    "no legend": ("profile", lambda v: v.legend.hide()),
    "no line of the legend": ("profile", lambda v: v.legend.show_line("band", False)),
    "threshold up": ("decode", shift_threshold),
    "colour of the threshold": (
        "decode",
        lambda v: v.signal.threshold.setPen(pg.mkPen("#0072b2", width=1)),
    ),
    "no bar": ("decode", lambda v: v.run_lengths.bars[0].setOpts(height=0)),
    "no verdict": ("decode", lambda v: v.verdict.setText("")),
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_of_a_pane_is_seen(request: pytest.FixtureRequest, name: str) -> None:
    pane, change = CHANGES[name]
    view = request.getfixturevalue(pane)
    before = settled(view)
    assert difference(settled(view), before).colour == 0.0
    change(view)
    assert not difference(settled(view), before).is_small


def test_other_hints_of_a_font_do_not_count(
    qapp: QApplication, profile: ProfileView, decode: DecodeView
) -> None:
    before = settled(profile), settled(decode)
    font = QFont(qapp.font())
    font.setHintingPreference(QFont.HintingPreference.PreferVerticalHinting)
    qapp.setFont(font)
    for view, picture in zip((profile, decode), before, strict=True):
        seen = difference(settled(view), picture)
        assert seen.is_small
        assert seen.colour > 0.0  # the text is drawn otherwise


def test_pictures_of_two_sizes_cannot_be_compared() -> None:
    small: Colours = np.zeros((30, 30, 3), dtype=np.uint8)
    with pytest.raises(ValueError, match=r"is \(30, 30, 3\), not \(30, 31, 3\)"):
        difference(small, np.zeros((30, 31, 3), dtype=np.uint8))
