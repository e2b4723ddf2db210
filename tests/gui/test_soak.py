"""Whatever is done in whatever order, the window lives, and its memory stays what it was.

It runs with ``--whole``: each action about once, or ``OCC_SOAK=20000`` of them. ``-rP``
prints by how much the memory grew; with ``-s`` nobody would look for Qt's warnings.
"""

import ctypes
import gc
import logging
import os
import sys
from collections.abc import Iterator
from contextlib import suppress
from functools import _lru_cache_wrapper
from pathlib import Path
from typing import Any, ClassVar

import pytest
from gui.soak_actions import FileDialogs, Monkey, smaller, smaller_lessons
from gui.soak_errands import install_plugins
from PySide6.QtGui import QGuiApplication
from pytestqt.qtbot import QtBot

from occ_gui.app.application import Application
from occ_gui.app.garbage_collection import GarbageCollector, give_memory_back
from occ_gui.lessons import lesson_controller as lessons_room

ACTIONS = int(os.environ.get("OCC_SOAK", 120))
_WINDOW = 5_000
"""Actions between two looks at the memory; after the first of them all that is kept is full."""

_MOST_GROWTH, _MOST_BLOCKS = 15e6, 30_000
"""Bytes, and blocks of Python, which hold some hundred bytes each.

What the panes keep of scenes before differs: over 1,200 movements of sliders 152 to 163 MB were in
use, up and down, and 1.355 to 1.359 million blocks.
"""


_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
"""Numbers of the parameters of mallopt."""

_AT_ONCE = 128 * 1024
"""Bytes from which memory is given back as soon as it is free."""


def keep_nothing_free() -> None:
    """Let the process give back what it has freed.

    By itself glibc comes to keep some 30 MB at the end of each thread's heap, which no
    ``malloc_trim`` reaches, and now and then gives them back: more than what is looked for here.
    """
    with suppress(OSError, AttributeError):
        libc = ctypes.CDLL("libc.so.6")
        libc.mallopt(_TRIM_THRESHOLD, _AT_ONCE)
        libc.mallopt(_MMAP_THRESHOLD, _AT_ONCE)


def memory(line: str) -> float:
    """Return a number of bytes that the system reports of this process."""
    text = Path("/proc/self/status").read_text(encoding="ascii")
    return 1024.0 * int(text.split(f"{line}:")[1].split()[0])


def empty_bounded_caches() -> None:
    """Forget what caches of a stated size hold: more for some scenes than for others.

    Those without a size stay: they would grow without an end.
    """
    for each in gc.get_objects():
        if isinstance(each, _lru_cache_wrapper) and each.cache_parameters()["maxsize"]:
            each.cache_clear()


def forget_ignored_messages(log: Any) -> None:
    """Forget the messages of Qt that pytest-qt keeps and does not look at."""
    log._records[:] = [each for each in log._records if not each.ignored]


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
    give_memory_back()
    try:
        report = ctypes.CDLL("libc.so.6").mallinfo2
    except (OSError, AttributeError):
        return memory("VmRSS"), sys.getallocatedblocks()
    report.restype = Allocated
    found = report()
    return float(found.uordblks + found.hblkhd), sys.getallocatedblocks()


class Growth:
    """What is used at the end of each window of actions, and what was at most within it."""

    def __init__(self) -> None:
        self.used: list[tuple[float, int]] = []
        self._forget_the_peak()

    def look(self, number: int) -> None:
        """Look now, after so many actions, and print it."""
        peak, left = memory("VmHWM"), memory("VmRSS")
        self.used.append(used_memory())
        (used, blocks), there = self.used[-1], memory("VmRSS")
        each = [f"{value / 1e6:.1f}" for value in (peak, left, there, used)]
        print(  # noqa: T201
            number, "actions, MB at most, at rest, without caches, and in use:", *each,
            "and blocks of Python:", blocks, flush=True,
        )  # fmt: skip
        self._forget_the_peak()

    @staticmethod
    def _forget_the_peak() -> None:
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


@pytest.fixture
def some_plugins(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Let the window find plug-ins when it starts."""
    with pytest.MonkeyPatch.context() as patch:
        yield from install_plugins(tmp_path_factory.mktemp("plug-ins"), patch)


@pytest.fixture(params=[1])
def monkey(
    request: pytest.FixtureRequest,
    some_plugins: None,
    application: Application,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> Iterator[Monkey]:
    """Let a monkey at the application, and leave the other tests their theme and clipboard."""
    monkeypatch.setattr(lessons_room, "lessons", smaller_lessons)
    GarbageCollector(application.window)  # as a program that runs has one: figures are in cycles
    yield Monkey(application, qtbot, FileDialogs(monkeypatch), tmp_path, request.param)
    application.options.theme.choose("system")
    QGuiApplication.clipboard().clear()


@pytest.mark.whole
def test_random_actions_cause_no_exception_warning_or_leak(
    monkey: Monkey, application: Application, caplog: pytest.LogCaptureFixture, qtlog: object
) -> None:
    if ACTIONS >= _WINDOW:
        keep_nothing_free()
        monkey.export_many()
    home = smaller(application.store.scene)
    application.store.put(home, "smaller")
    growth = Growth()
    for number in range(1, ACTIONS + 1):
        monkey.act()
        if number % 5 == 0:
            monkey.wait()
        if number % _WINDOW == 0:
            monkey.come_home(home)
            forget_ignored_messages(qtlog)
            growth.look(number)
    monkey.come_home(home)
    assert application.simulation.runner.is_idle
    # A mistake of ours on another thread becomes a sentence on the screen, and a line here.
    assert [each.message for each in caplog.records if each.levelno >= logging.WARNING] == []
    if growth.used:
        (first, blocks), (last, more) = growth.used[0], growth.used[-1]
        assert last - first < _MOST_GROWTH
        assert more - blocks < _MOST_BLOCKS
