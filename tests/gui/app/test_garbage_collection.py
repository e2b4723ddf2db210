"""Cyclic garbage is collected on the window's thread, and on no other."""

import gc
import threading
import time
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from PySide6.QtCore import QObject
from pytestqt.qtbot import QtBot

from occ_gui.app import garbage_collection
from occ_gui.app.garbage_collection import GarbageCollector


class Cycle:
    """An object that only the cyclic collector frees; records on which thread."""

    freed_on: ClassVar[list[threading.Thread]] = []

    def __init__(self) -> None:
        self.own = self

    def __del__(self) -> None:
        self.freed_on.append(threading.current_thread())


def test_garbage_is_freed_by_the_window_and_never_by_a_worker(qtbot: QtBot) -> None:
    owner = QObject()
    collector = GarbageCollector(owner)
    gc.collect()
    Cycle.freed_on.clear()
    Cycle()
    collector.collect()
    assert Cycle.freed_on == [], "little has been allocated"
    objects: list[list[int]] = []
    worker = threading.Thread(target=lambda: objects.extend([n] for n in range(200_000)))
    worker.start()
    worker.join()
    assert Cycle.freed_on == []
    assert gc.get_count()[0] > gc.get_threshold()[0]
    collector.collect()
    assert Cycle.freed_on == [threading.main_thread()]
    owner.deleteLater()


def test_memory_is_returned_once_after_each_period_of_work_when_idle(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock, returns, ends = [0.0, 0.0], list[float](), list[float]()
    monkeypatch.setattr(time, "monotonic", lambda: clock[0])
    monkeypatch.setattr(time, "process_time", lambda: clock[1])
    monkeypatch.setattr(garbage_collection, "return_freed_memory", lambda: returns.append(clock[0]))
    owner = QObject()
    collector = GarbageCollector(owner)
    for busy, seconds in ((0.9, 3), (0.01, 10), (0.9, 3), (0.01, 10), (0.9, 0.5), (0.01, 10)):
        for _ in range(int(4 * seconds)):
            clock[0] += 0.25
            clock[1] += 0.25 * busy
            collector.collect()
        ends.append(clock[0])
    assert len(returns) == 2, "not again after half a second of work"
    assert ends[0] + 2.0 <= returns[0] <= ends[0] + 3.0
    assert ends[2] + 2.0 <= returns[1] <= ends[2] + 3.0
    owner.deleteLater()


def test_the_memory_of_freed_arrays_is_returned(qtbot: QtBot) -> None:
    def measure_memory() -> int:
        return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * 4096

    # Every other block stays, so that the heap cannot simply be cut off at its end.
    blocks = [np.ones(100_000, np.uint8) for _ in range(1000)]
    before = measure_memory()
    del blocks[::2]
    garbage_collection.return_freed_memory()
    assert before - measure_memory() > 20e6
