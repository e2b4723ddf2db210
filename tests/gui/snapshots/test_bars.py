"""The photo's verdict and the cards of the limits look like their stored pictures, in both themes.

See test_panes for renewing them.
"""

from collections.abc import Callable

import pytest
from gui.snapshots.drawing import show
from matches import match_with
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.detection_map.limit_cards import LimitCards
from occ_gui.photo.photo_verdict_bar import PhotoVerdictBar
from occ_gui.widgets.state_look import State
from occ_gui.window.style_sheet import style_sheet
from occ_gui.window.theme import palette_of
from occ_model.photo.reading.load import Photo
from occ_model.results.limits import RangeEnd, ReadInterval, Trial, WorkingRange
from occ_model.results.match import Match
from occ_model.scene.scene import Scene

Matches = Callable[[QWidget, str], None]
THEMES = pytest.mark.parametrize("theme", ["light", "dark"])


def match_of(scene: Scene, *reasons: str) -> Match:
    return match_with(scene=scene, reasons=reasons)


def trial(frequency: float, right: int) -> Trial:
    return Trial(frequency, right, 100, float(right), float(right), 10, right // 10)


@THEMES
@pytest.mark.parametrize(
    ("name", "reasons"),
    [("sure", ()), ("doubtful", ("Only 1.2 periods of 4 chips are in view; 3 are needed.",))],
)
def test_the_verdict_on_a_photo_looks_as_stored(
    qtbot: QtBot,
    small_scene: Scene,
    photo: Photo,
    matches_its_picture: Matches,
    theme: str,
    name: str,
    reasons: tuple[str, ...],
) -> None:
    QApplication.setPalette(palette_of(theme))
    bar = PhotoVerdictBar()
    show(qtbot, bar, 820, 50)
    bar.show_photo(photo)
    bar.show_match(match_of(small_scene, *reasons))
    bar.show_applied(name == "sure")
    bar.show_simulation(State.BAD, "Simulation: no code: no header found")
    bar.resize(820, bar.sizeHint().height())  # as high as its lines, as a layout makes it
    matches_its_picture(bar, f"photo-verdict-{name}-{theme}")


@THEMES
def test_the_cards_of_the_limits_look_as_stored(
    qtbot: QtBot, matches_its_picture: Matches, theme: str
) -> None:
    palette = palette_of(theme)
    QApplication.setPalette(palette)
    cards = LimitCards(("threshold", "matched", "equalizer"))
    cards.setStyleSheet(style_sheet(palette))
    show(qtbot, cards, 760, 84)
    read = RangeEnd(trial(14.2e3, 100), trial(14.3e3, 0), trial(14.1e3, 100))
    cards.cards["threshold"].show_limit(read, "It reads up to 14.2 kHz.", 99.0)
    ends = RangeEnd(trial(3.5e3, 100), None), RangeEnd(trial(14.2e3, 100), trial(14.3e3, 0))
    cards.cards["threshold"].show_range(
        WorkingRange(
            "switching_frequency", (500.0, 100e3), 1.15, trial(10e3, 100), (ReadInterval(*ends),)
        )
    )
    cards.cards["matched"].show_searching()
    cards.cards["equalizer"].show_limit(None, "It reads at no frequency.", 99.0)
    matches_its_picture(cards, f"limit-cards-{theme}")
