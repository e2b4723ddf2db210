"""The comparison of pictures sees what an eye sees, and lets pass what only a system draws."""

import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import SnapshotOf
from gui.snapshots.gallery import Colours, Gallery, difference, grab_at_rest
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QApplication

from occ_gui.profile.profile_view import ProfileView


@pytest.fixture
def profile(gallery: Gallery, snapshot_of: SnapshotOf) -> ProfileView:
    view = gallery.show(ProfileView(), 560, 260)
    view.show_reading(snapshot_of())
    return view


def test_each_change_of_a_pane_is_seen(profile: ProfileView) -> None:
    a_pixel, _ = profile.plot.getViewBox().viewPixelSize()
    before = grab_at_rest(profile)
    assert difference(grab_at_rest(profile), before).colour == 0.0
    profile.simulation.setPos(a_pixel, 0)
    aside = grab_at_rest(profile)
    assert not difference(aside, before).is_small
    profile.simulation.setPen(pg.mkPen("#009e73"))
    coloured = grab_at_rest(profile)
    assert not difference(coloured, aside).is_small
    profile.legend.show_line("band", False)
    assert not difference(grab_at_rest(profile), coloured).is_small


def test_other_hints_of_a_font_do_not_count(qapp: QApplication, profile: ProfileView) -> None:
    before = grab_at_rest(profile)
    font = QFont(qapp.font())
    font.setHintingPreference(QFont.HintingPreference.PreferVerticalHinting)
    qapp.setFont(font)
    seen = difference(grab_at_rest(profile), before)
    assert seen.is_small
    assert seen.colour > 0.0  # the text is drawn otherwise


def test_pictures_of_two_sizes_cannot_be_compared() -> None:
    small: Colours = np.zeros((30, 30, 3), dtype=np.uint8)
    with pytest.raises(ValueError, match=r"is \(30, 30, 3\), not \(30, 31, 3\)"):
        difference(small, np.zeros((30, 31, 3), dtype=np.uint8))
