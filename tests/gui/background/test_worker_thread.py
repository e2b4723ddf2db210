"""A worker's thread begins with its first work, and never again after its end."""

import threading

from PySide6.QtCore import QObject, Qt, Signal, Slot
from pytestqt.qtbot import QtBot

from occ_gui.background.worker_thread import WorkerThread


class Worker(QObject):
    asked = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.done_on: list[int] = []
        self.asked.connect(self.work, Qt.ConnectionType.QueuedConnection)

    @Slot()
    def work(self) -> None:
        self.done_on.append(threading.get_ident())


def test_work_waits_for_the_thread_and_is_done_on_it(qtbot: QtBot) -> None:
    worker = Worker()
    thread = WorkerThread(worker, "work")
    worker.asked.emit()
    qtbot.wait(20)
    assert worker.done_on == []
    thread.begin()
    qtbot.waitUntil(lambda: bool(worker.done_on))
    assert threading.get_ident() not in worker.done_on
    thread.end()


def test_no_thread_begins_after_its_end(qtbot: QtBot) -> None:
    worker = Worker()
    thread = WorkerThread(worker, "work")
    thread.end()
    thread.begin()
    worker.asked.emit()
    qtbot.wait(20)
    assert worker.done_on == []
