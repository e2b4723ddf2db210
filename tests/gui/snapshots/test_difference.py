"""The comparison of pictures sees what an eye sees, and lets pass what only a system draws."""

from collections.abc import Callable

import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import SnapshotOf
from gui.snapshots.difference import Colours, difference
from gui.snapshots.drawing import settled, show
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


def shift_curve_aside(view: ProfileView) -> None:
    view.simulation.setPos(pixel(view.plot)[0], 0)


def shift_curve_up(view: ProfileView) -> None:
    view.simulation.setPos(0, pixel(view.plot)[1])


def shift_dashed_curve(view: ProfileView) -> None:
    view.band.setPos(pixel(view.plot)[0], 0)


def change_colour(view: ProfileView) -> None:
    view.simulation.setPen(pg.mkPen("#009e73"))


def lose_curve(view: ProfileView) -> None:
    view.band.hide()


def lose_legend(view: ProfileView) -> None:
    view.legend.hide()


def lose_line_of_legend(view: ProfileView) -> None:
    view.legend.show_line("band", False)


CHANGES = (
    shift_curve_aside,
    shift_curve_up,
    shift_dashed_curve,
    change_colour,
    lose_curve,
    lose_legend,
    lose_line_of_legend,
)


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_of_the_profile_is_seen(
    profile: ProfileView, change: Callable[[ProfileView], None]
) -> None:
    before = settled(profile)
    change(profile)
    assert not difference(settled(profile), before).is_small


def shift_threshold(view: DecodeView) -> None:
    line = view.signal.threshold
    line.setValue(line.value() + pixel(view.signal.plot)[1])


def change_threshold_colour(view: DecodeView) -> None:
    view.signal.threshold.setPen(pg.mkPen("#0072b2", width=1))


def lose_bar(view: DecodeView) -> None:
    view.run_lengths.bars[0].setOpts(height=0)


def lose_verdict(view: DecodeView) -> None:
    view.verdict.setText("")


@pytest.mark.parametrize(
    "change", [shift_threshold, change_threshold_colour, lose_bar, lose_verdict]
)
def test_a_change_of_the_decoders_steps_is_seen(
    decode: DecodeView, change: Callable[[DecodeView], None]
) -> None:
    before = settled(decode)
    change(decode)
    assert not difference(settled(decode), before).is_small


def test_the_same_pane_drawn_again_does_not_differ(profile: ProfileView) -> None:
    assert difference(settled(profile), settled(profile)).colour == 0.0


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
