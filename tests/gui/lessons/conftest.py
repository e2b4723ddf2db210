"""The lessons, opened without the window around them."""

from collections.abc import Iterator

import pytest
from gui.lessons.bench import Lessons
from pytestqt.qtbot import QtBot

from occ_gui.lessons.lesson_view import LessonView
from occ_model.scene.scene import Scene


@pytest.fixture
def bench(qtbot: QtBot, small_scene: Scene) -> Iterator[Lessons]:
    """Open the lessons."""
    bench = Lessons(qtbot, small_scene)
    yield bench
    bench.stop()


@pytest.fixture
def guide(bench: Lessons) -> LessonView:
    """Give the view of the lessons."""
    return bench.guide
