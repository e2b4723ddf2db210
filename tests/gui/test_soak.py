"""Whatever is done in whatever order, the window lives, and its memory stays what it was.

It runs with ``--whole``: each action about once, or ``OCC_SOAK=20000`` of them, and from another
seed with ``OCC_SOAK_SEED``. ``-rP``
prints by how much the memory grew; with ``-s`` nobody would look for Qt's warnings.
"""

import ctypes
import gc
import logging
import os
import sys
from collections.abc import Iterator
from functools import _lru_cache_wrapper
from pathlib import Path
from typing import Any, ClassVar

import pytest
from gui.soak_actions import FileDialogs, Monkey, smaller, smaller_lessons
from model.plugins.installed_package import importable
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.app.garbage_collection import GarbageCollector, return_freed_memory
from occ_gui.lessons import lesson_controller as lessons_room
from occ_model import plugins

ACTIONS = int(os.environ.get("OCC_SOAK", 120))
SEED = int(os.environ.get("OCC_SOAK_SEED", 1))
_WINDOW = 5_000
"""Actions between two looks at the memory; after the first of them all that is kept is full."""

_MOST_GROWTH, _MOST_BLOCKS = 15e6, 30_000
"""Bytes, and blocks of Python, which hold some hundred bytes each.

What the panes keep of scenes before differs: over 1,200 movements of sliders 152 to 163 MB were in
use, up and down, and 1.355 to 1.359 million blocks.
"""


def empty_bounded_caches() -> None:
    """Forget what caches of a stated size hold: more for some scenes than for others.

    Those without a size stay: they would grow without an end.
    """
    for each in gc.get_objects():
        if isinstance(each, _lru_cache_wrapper) and each.cache_parameters()["maxsize"]:
            each.cache_clear()


class Allocated(ctypes.Structure):
    """What glibc reports of its allocations, in its own order."""

    _fields_: ClassVar = [
        (name, ctypes.c_size_t)
        for name in (
            "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
            "fordblks", "keepcost",
        )
    ]  # fmt: skip


def used_memory() -> tuple[float, int]:
    """Return the bytes that Qt, numpy and others have allocated now, and Python's blocks.

    What the system counts holds also the room between them, which comes and goes by 10 MB.
    """
    empty_bounded_caches()
    gc.collect()
    return_freed_memory()
    report = ctypes.CDLL("libc.so.6").mallinfo2
    report.restype = Allocated
    found = report()
    return float(found.uordblks + found.hblkhd), sys.getallocatedblocks()


PLUGINS = """
import occ_model as occ

def read(signal, scene):
    bits = scene.transmitter.payload_bits
    return occ.read_payload(occ.DecodeResult("reads", signal=signal, chips=bits), scene)

def fail(signal, scene):
    raise ValueError("not today")

reads = occ.Decoder("reads", "Reads", read)
fails = occ.Decoder("fails", "Fails", fail)
"""


@pytest.fixture
def some_plugins(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Install a decoder of another package that works, and one that fails."""
    folder = tmp_path_factory.mktemp("plug-ins")
    offered = {name: f"soaked:{name}" for name in ("reads", "fails")}
    with importable(folder, "soaked", {plugins.DECODERS: offered}, PLUGINS):
        yield


@pytest.fixture
def monkey(
    some_plugins: None, application: Application, qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path,
) -> Iterator[Monkey]:  # fmt: skip
    """Act at random on the application; restore theme and clipboard for the other tests."""
    monkeypatch.setattr(lessons_room, "lessons", smaller_lessons)
    GarbageCollector(application.window)  # as a program that runs has one: figures are in cycles
    monkey = Monkey(application, qtbot, FileDialogs(monkeypatch), tmp_path, seed=SEED)
    status_line = application.window.statusBar().messageChanged
    status_line.connect(monkey.check_message)
    yield monkey
    status_line.disconnect(monkey.check_message)
    application.options.theme.choose("system")
    QGuiApplication.clipboard().clear()


@pytest.mark.whole
def test_random_actions_cause_no_exception_warning_or_leak(
    monkey: Monkey, application: Application, caplog: pytest.LogCaptureFixture, qtlog: Any
) -> None:
    home = smaller(application.scene_store.scene)
    application.scene_store.put(home, "smaller")
    used: list[tuple[float, int]] = []
    for number in range(1, ACTIONS + 1):
        monkey.act()
        if number % 5 == 0:
            monkey.wait()
        if number % _WINDOW == 0:
            monkey.close_everything(home)
            # pytest-qt keeps messages of Qt that it does not look at.
            qtlog._records[:] = [each for each in qtlog._records if not each.ignored]
            used.append(used_memory())
            print(number, "actions, bytes in use and blocks of Python:", used[-1])  # noqa: T201
    monkey.close_everything(home)
    assert application.simulation.task.is_idle
    # A mistake of ours on another thread becomes a sentence on the screen, and a line here.
    assert [each.message for each in caplog.records if each.levelno >= logging.WARNING] == []
    if used:
        (first, blocks), (last, more) = used[0], used[-1]
        assert last - first < _MOST_GROWTH
        assert more - blocks < _MOST_BLOCKS
