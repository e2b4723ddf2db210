"""A photo's pane and a match to show on it."""

import pytest
from gui.photo.photo_bench import LiveView
from matches import match_with
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.photo.photo_view import PhotoView
from occ_model.results.match import Match


@pytest.fixture
def view(qtbot: QtBot) -> PhotoView:
    view = LiveView()
    qtbot.addWidget(view)
    qtbot.addWidget(view.verdict)  # which stands elsewhere in the window
    view.resize(380, 500)
    view.show()
    view.show_scene(occ.Scene())
    return view


@pytest.fixture
def match() -> Match:
    return match_with()
