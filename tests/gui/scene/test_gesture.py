"""Which changes of a control are undone together: those that follow each other quickly."""

import pytest
from pytestqt.qtbot import QtBot

from occ_gui.scene import gesture
from occ_gui.scene.gesture import Gestures, new_gesture


def test_changes_without_a_pause_are_one_gesture_and_no_others() -> None:
    one, other = Gestures(), Gestures()
    assert one.of_change() == one.of_change() == one.of_change()
    assert len({one.of_change(), other.of_change(), new_gesture()}) == 3


def test_a_pause_ends_a_gesture_unless_it_is_held(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gesture, "_PAUSE_MS", 1)
    gestures = Gestures()
    first = gestures.of_change()
    qtbot.wait(10)
    held = gestures.of_change(held=True)
    qtbot.wait(10)
    last = gestures.of_change()
    assert held == first
    assert last != first


def test_a_gesture_that_has_ended_takes_nothing_more() -> None:
    gestures = Gestures()
    first = gestures.of_change()
    gestures.end()
    assert gestures.of_change(held=True) != first
