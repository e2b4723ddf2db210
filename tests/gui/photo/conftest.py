"""A photo's pane and a match to show on it."""

import pytest
from gui.kinds import add_widget
from gui.photo.photo_bench import LiveView
from matches import match_with
from pytestqt.qtbot import QtBot

from occ_gui.photo.photo_view import PhotoView
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match


@pytest.fixture
def view(qtbot: QtBot, photo: Photo) -> PhotoView:
    """Show the pane of a photo that is open."""
    view = add_widget(qtbot, LiveView())
    qtbot.addWidget(view.verdict)  # which stands elsewhere in the window
    view.resize(380, 500)
    view.show()
    view.open(photo)
    return view


@pytest.fixture
def match() -> Match:
    return match_with()
