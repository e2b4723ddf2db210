"""Cyclic garbage is collected on the window's thread, and on no other."""

import gc
import threading
from typing import ClassVar

from PySide6.QtCore import QObject
from pytestqt.qtbot import QtBot

from occ_gui.app.garbage_collection import GarbageCollector


class Cycle:
    """Something that only the cyclic collector frees; it notes on which thread."""

    freed_on: ClassVar[list[threading.Thread]] = []

    def __init__(self) -> None:
        self.own = self

    def __del__(self) -> None:
        self.freed_on.append(threading.current_thread())


def test_garbage_is_freed_by_the_window_and_never_by_a_worker(qtbot: QtBot) -> None:
    owner = QObject()
    collector = GarbageCollector(owner)
    Cycle.freed_on.clear()
    Cycle()
    kept: list[list[int]] = []
    worker = threading.Thread(target=lambda: kept.extend([n] for n in range(200_000)))
    worker.start()
    worker.join()
    assert Cycle.freed_on == []
    assert gc.get_count()[0] > gc.get_threshold()[0]
    collector.collect()
    assert Cycle.freed_on == [threading.main_thread()]
    owner.deleteLater()


def test_nothing_is_done_where_little_has_been_allocated(qtbot: QtBot) -> None:
    owner = QObject()
    collector = GarbageCollector(owner)
    gc.collect()
    Cycle.freed_on.clear()
    Cycle()
    collector.collect()
    assert Cycle.freed_on == []
    gc.collect()
    assert len(Cycle.freed_on) == 1
    owner.deleteLater()
