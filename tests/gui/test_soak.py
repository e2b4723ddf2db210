"""Whatever is done in whatever order, the window lives, and its memory stays what it was.

``OCC_SOAK=20000`` does as many random actions; every day it is some hundred.
"""

import ctypes
import gc
import os
import random
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.application import Application
from occ_gui.controllers.files import sample_photos
from occ_gui.state.gesture import new_gesture
from occ_gui.views.photo_overlay import MODES
from occ_model.declarations import Choice, Count, Quantity
from occ_model.effects.registry import NAMES
from occ_model.parameters import PARAMETERS

ACTIONS = int(os.environ.get("OCC_SOAK", "300"))
_LONG = 5_000
"""Actions after whose first fifth all that is kept on purpose has been filled."""

_MOST_GROWTH = 5e6
"""Bytes."""

_HEAVY = ("rows", "columns", "point_spread", "distance", "panel_width", "panel_height")
"""What would make pictures so large, or blurs so wide, that a soak is about them alone."""


def resident_bytes() -> float:
    """Give the memory that the process uses now, without what it keeps free for later."""
    gc.collect()
    with suppress(OSError, AttributeError):
        ctypes.CDLL("libc.so.6").malloc_trim(0)
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return float(pages * os.sysconf("SC_PAGE_SIZE"))


class Monkey:
    """Does random things to a window."""

    def __init__(self, application: Application, qtbot: QtBot, seed: int) -> None:
        self._application = application
        self._qtbot = qtbot
        self._random = random.Random(seed)
        self._gesture = new_gesture()
        self._deeds: list[tuple[int, Callable[[], object]]] = [
            (60, self.move_a_slider),
            (4, self.choose_a_word),
            (4, self.change_the_code),
            (6, self.undo_or_redo),
            (3, self.load_a_preset),
            (2, self.force_an_effect),
            (2, self.change_the_tolerance),
            (1, self.open_a_sample),
            (1, self.close_the_photo),
            (3, self.choose_a_mode),
            (3, self.toggle_a_dock),
            (2, self.ask_for_what_cannot_be),
            (1, self.resize),
        ]

    def act(self) -> None:
        """Do something."""
        (deed,) = self._random.choices(
            [deed for _, deed in self._deeds], [weight for weight, _ in self._deeds]
        )
        deed()

    def move_a_slider(self) -> None:
        names = [n for n, p in PARAMETERS.items() if isinstance(p, Quantity) and n not in _HEAVY]
        declared = PARAMETERS[self._random.choice(names)]
        assert isinstance(declared, Quantity)
        if self._random.random() < 0.3:
            self._gesture = new_gesture()
        value = declared.at(self._random.random())
        self._application.store.change(self._gesture, **{declared.name: value})

    def choose_a_word(self) -> None:
        names = [n for n, p in PARAMETERS.items() if isinstance(p, Choice)]
        declared = PARAMETERS[self._random.choice(names)]
        assert isinstance(declared, Choice)
        word = self._random.choice(declared.choices)
        self._application.store.change(**{declared.name: word})

    def change_the_code(self) -> None:
        declared = PARAMETERS["code"]
        assert isinstance(declared, Count)
        self._application.store.change(code=self._random.randrange(1024), bits=10)

    def undo_or_redo(self) -> None:
        stack = self._application.store.undo_stack
        self._random.choice([stack.undo, stack.redo])()

    def load_a_preset(self) -> None:
        scene = occ.load_preset(self._random.choice(occ.presets()))
        self._application.store.put(scene.replace(rows=150, columns=1200), "preset")

    def force_an_effect(self) -> None:
        included = self._random.choice([True, False, None, None])
        self._application.settings.force(self._random.choice(NAMES), included)

    def change_the_tolerance(self) -> None:
        self._application.settings.set_tolerance(10.0 ** self._random.uniform(-1.0, 2.0))

    def open_a_sample(self) -> None:
        self._application.open_photo(self._random.choice(sample_photos()))

    def close_the_photo(self) -> None:
        self._application.photos.close()

    def choose_a_mode(self) -> None:
        self._application.image.set_mode(self._random.choice(MODES))

    def toggle_a_dock(self) -> None:
        docks = list(self._application.window.docks.values())
        self._random.choice(docks).toggleViewAction().trigger()

    def ask_for_what_cannot_be(self) -> None:
        self._application.store.change(exposure_time=-1.0)
        self._application.settings.set_tolerance(float("nan"))
        self._application.open_photo(Path("/nowhere/photo.png"))

    def resize(self) -> None:
        width = self._random.randrange(1000, 1600)
        self._application.window.resize(width, self._random.randrange(700, 1000))


@pytest.mark.parametrize("seed", [1])
def test_random_actions_leave_no_exception_no_warning_and_no_memory(
    application: Application, qtbot: QtBot, seed: int
) -> None:
    application.store.put(application.store.scene.replace(columns=1200), "smaller")
    monkey = Monkey(application, qtbot, seed)
    before = 0.0
    for number in range(ACTIONS):
        monkey.act()
        if number % 5 == 4:
            qtbot.waitUntil(lambda: application.is_idle, timeout=20_000)
        if number == ACTIONS // 5:
            before = resident_bytes()
    qtbot.waitUntil(lambda: application.is_idle, timeout=20_000)
    growth = resident_bytes() - before
    print(f"{ACTIONS} actions, memory grew by {growth / 1e6:.1f} MB after the first fifth")  # noqa: T201
    assert application.simulation.runner.is_idle
    if ACTIONS >= _LONG:
        assert growth < _MOST_GROWTH
