"""A worker's thread begins with its first work, and never again after its end."""

import threading
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QObject, Qt, Signal, Slot
from pytestqt.qtbot import QtBot

from occ_gui.background import worker_thread
from occ_gui.background.worker_thread import WorkerThread
from occ_model import plugins

PATIENCE_S = 60.0


class Worker(QObject):
    asked = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.done_on: list[int] = []
        self.asked.connect(self.work, Qt.ConnectionType.QueuedConnection)

    @Slot()
    def work(self) -> None:
        self.done_on.append(threading.get_ident())


def test_work_waits_for_the_thread_and_none_begins_after_its_end(qtbot: QtBot) -> None:
    worker = Worker()
    thread = WorkerThread(worker, "work")
    worker.asked.emit()
    qtbot.wait(20)
    assert worker.done_on == []
    thread.begin()
    qtbot.waitUntil(lambda: bool(worker.done_on))
    assert threading.get_ident() not in worker.done_on
    thread.end()
    worker = Worker()
    thread = WorkerThread(worker, "work")
    thread.end()
    thread.begin()
    worker.asked.emit()
    qtbot.wait(20)
    assert worker.done_on == []


@pytest.fixture
def busy(qtbot: QtBot) -> Iterator[tuple[WorkerThread, threading.Event, list[str]]]:
    """Return a thread at work on what ends with an event, and what it has done."""
    done: list[str] = []
    begun, go_on = threading.Event(), threading.Event()

    class Holding(Worker):
        @Slot()
        def work(self) -> None:
            with plugins.at_work("The plug-in"):
                begun.set()
                go_on.wait()
            done.append("plug-in")

    worker = Holding()
    thread = WorkerThread(worker, "work")
    thread.begin()
    worker.asked.emit()
    assert begun.wait(PATIENCE_S)
    yield thread, go_on, done
    go_on.set()
    while worker_thread._left:
        worker_thread._left.pop().wait()


def test_a_plug_in_that_does_not_come_back_is_left_behind(
    busy: tuple[WorkerThread, threading.Event, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker_thread, "PATIENCE_MS", 20)
    thread, _, done = busy
    thread.end()
    assert done == []
    assert plugins.all_at_work() == ("The plug-in",)


def test_a_plug_in_that_comes_back_in_time_is_waited_for(
    busy: tuple[WorkerThread, threading.Event, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(worker_thread, "PATIENCE_MS", 1e9)
    thread, go_on, done = busy
    threading.Timer(0.1, go_on.set).start()
    thread.end()
    assert done == ["plug-in"]
    assert plugins.all_at_work() == ()
