"""The photo's pane is idle where nothing works for it."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from gui.user import User
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.photo.wiring import PhotoWiring
from occ_model.results.decoding import Region

PARTS = ("photos", "matching", "many", "lamps", "comparison", "chips")


def wiring(busy: str) -> SimpleNamespace:
    tasks = {name: SimpleNamespace(is_idle=name != busy) for name in PARTS}
    return SimpleNamespace(**{n: SimpleNamespace(runner=task) for n, task in tasks.items()})


@pytest.mark.parametrize("busy", ["", *PARTS])
def test_the_photo_is_idle_where_none_of_its_controllers_works(busy: str) -> None:
    assert PhotoWiring.is_idle.fget(wiring(busy)) is not bool(busy)  # type: ignore[attr-defined]


def test_a_rectangle_that_is_drawn_is_the_one_matched(
    application: Application, user: User, qtbot: QtBot, photo_file: Path
) -> None:
    application.open_photo(photo_file)
    user.wait_until_idle()
    wiring = application.shell.pane("photo")
    wiring.lamps.set_by_hand(True)
    wiring.outlines.drawn.emit(Region(5, 25, 10, 40))
    assert wiring.lamps.by_hand == wiring.matching._region == Region(5, 25, 10, 40)
    form = application.view("photo").lamps
    form.whole_asked.emit()
    assert wiring.lamps.by_hand is None
    form.by_hand_chosen.emit(True)
    assert wiring.lamps.by_hand is not None
    with qtbot.waitSignal(wiring.lamps.searching):
        form.find_asked.emit()
    user.wait_until_idle()
