"""The job scheduler in the window: results and failures arrive on the window's thread."""

import errno
import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from typing import Any, NoReturn

import pytest
from pytestqt.qtbot import QtBot
from worker_calls import HeldWorker, echo, fail, wait_until

from occ_gui.background.signals import JobChannel, WorkQueue
from occ_model.parallel.job import Job, JobResult


def jobs(*values: Any) -> Iterator[Job]:
    return (Job(echo, (value,)) for value in values)


class Received:
    def __init__(self, channel: JobChannel) -> None:
        self.results: list[tuple[Any, Any]] = []
        self.threads: set[int] = set()
        self.finished: list[Any] = []
        self.failures: list[str] = []
        self.messages: list[str] = []
        channel.results_ready.connect(self._take)
        channel.finished.connect(self.finished.append)
        channel.failed.connect(self.failures.append)
        channel.status_message.connect(self.messages.append)

    def _take(self, request: Any, found: list[Any]) -> None:
        self.threads.add(threading.get_ident())
        self.results.extend((request, each) for each in found)


@pytest.fixture
def queue_of(qtbot: QtBot) -> Iterator[Callable[..., WorkQueue]]:
    queues: list[WorkQueue] = []

    def make(workers: Any, channels: int = 1) -> WorkQueue:
        queues.append(WorkQueue(channels, lambda: workers))
        return queues[-1]

    yield make
    for queue in queues:
        queue.stop()


def test_all_results_arrive_on_this_thread_and_then_the_end(
    qtbot: QtBot, queue_of: Callable[..., WorkQueue], inline_workers: Any
) -> None:
    channel, other = queue_of(inline_workers, 2).channels
    received, others = Received(channel), Received(other)
    other.put("other", jobs(4))
    channel.put("request", jobs(1, 2, 3))
    assert not channel.is_idle
    qtbot.waitUntil(lambda: channel.is_idle and other.is_idle)
    assert received.results == [("request", 1), ("request", 2), ("request", 3)]
    assert received.finished == ["request"]
    assert others.results == [("other", 4)]
    assert received.threads == {threading.get_ident()}


def test_what_is_completed_is_shown_before_the_request_that_replaces_it(
    qtbot: QtBot, queue_of: Callable[..., WorkQueue]
) -> None:
    worker = HeldWorker()
    (channel,) = queue_of(worker).channels
    received = Received(channel)
    channel.put("first", jobs("f"))
    wait_until(lambda: len(worker.held) == 1)
    worker.finish()
    qtbot.waitUntil(lambda: channel.is_idle)
    channel.put("old", iter([Job(echo, (value,), uninterruptible=True) for value in "ab"]))
    wait_until(lambda: len(worker.held) == 2)
    channel.put("new", jobs("x", "y"))
    worker.finish(2)
    wait_until(lambda: len(worker.held) == 2)
    worker.finish(2)
    qtbot.waitUntil(lambda: channel.is_idle)
    assert received.results[1:] == [("old", "a"), ("old", "b"), ("new", "x"), ("new", "y")]
    assert received.finished == ["first", "new"]


def test_results_that_come_together_are_shown_together(
    qtbot: QtBot, queue_of: Callable[..., WorkQueue]
) -> None:
    worker = HeldWorker()
    (channel,) = queue_of(worker).channels
    shown: list[list[Any]] = []
    channel.results_ready.connect(lambda _, results: shown.append(results))
    channel.put("request", jobs(*"abcdef"))
    for _ in range(4):
        wait_until(lambda: len(worker.held) == 2)
        worker.finish()
    wait_until(lambda: len(worker.held) == 2)
    qtbot.waitUntil(lambda: len(shown) == 2)
    assert shown == [["a"], ["b", "c", "d"]]
    channel.put("next", jobs(*"xyz"))
    worker.finish(2)
    for _ in range(2):
        wait_until(lambda: len(worker.held) == 2)
        worker.finish()
    qtbot.waitUntil(lambda: len(shown) == 4)
    assert shown[2] == ["x"], "the first results of a request do not wait for others"


def test_after_cancelling_nothing_arrives(qtbot: QtBot, queue_of: Callable[..., WorkQueue]) -> None:
    worker = HeldWorker()
    (channel,) = queue_of(worker).channels
    received = Received(channel)
    channel.put("request", jobs("a", "b"))
    qtbot.waitUntil(lambda: len(worker.held) == 2)
    channel.cancel()
    assert channel.is_idle
    qtbot.waitUntil(lambda: (0, 2) in worker.abandoned)
    worker.finish()
    qtbot.wait(30)
    assert (received.results, received.finished) == ([], [])


def test_an_error_is_a_sentence_and_the_next_request_is_done(
    qtbot: QtBot,
    queue_of: Callable[..., WorkQueue],
    inline_workers: Any,
    caplog: pytest.LogCaptureFixture,
) -> None:
    (channel,) = queue_of(inline_workers).channels
    received = Received(channel)
    channel.put("bad", iter([Job(fail, ("luck",))]))
    qtbot.waitUntil(lambda: channel.is_idle)
    assert received.failures == ["The work in the background failed: ValueError: no luck."]
    assert "failed for 'bad'" in caplog.text
    channel.put("good", jobs(1))
    qtbot.waitUntil(lambda: channel.is_idle)
    assert received.results == [("good", 1)]


def test_workers_that_keep_dying_are_reported(
    qtbot: QtBot, queue_of: Callable[..., WorkQueue]
) -> None:
    class Dying(HeldWorker):
        def submit(self, job: Job, channel: int, run: int) -> "Future[JobResult]":
            future = super().submit(job, channel, run)
            self.die()
            return future

    worker = Dying()
    (channel,) = queue_of(worker).channels
    received = Received(channel)
    channel.put("request", jobs(1))
    qtbot.waitUntil(lambda: channel.is_idle)
    assert received.failures == ["Processes in the background ended 3 times without a result."]
    assert received.messages == 2 * [
        "A background process ended unexpectedly; its work is done again."
    ]
    assert worker.renewed == 3


def test_without_processes_the_work_is_done_nevertheless(qtbot: QtBot) -> None:
    def no_processes() -> NoReturn:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    queue = WorkQueue(1, no_processes)
    (channel,) = queue.channels
    received = Received(channel)
    channel.put("request", jobs(1, 2, 3))
    qtbot.waitUntil(lambda: channel.is_idle)
    queue.stop()
    assert [found for _, found in received.results] == [1, 2, 3]
    assert received.failures == []
    (sentence,) = received.messages
    assert sentence.startswith("No background processes can be started (")
    assert sentence.endswith(
        "): the window does their work itself, and responds more slowly meanwhile."
    )


def test_stopping_ends_the_workers_and_nothing_arrives_any_more(
    qtbot: QtBot, queue_of: Callable[..., WorkQueue]
) -> None:
    worker = HeldWorker()
    queue = queue_of(worker)
    (channel,) = queue.channels
    received = Received(channel)
    channel.put("request", jobs("a"))
    qtbot.waitUntil(lambda: len(worker.held) == 1)
    queue.stop()
    queue.stop()
    assert worker.closed == 1
    channel.put("late", jobs("b"))
    qtbot.wait(30)
    assert (received.results, received.failures) == ([], [])
    assert queue_of(HeldWorker()).count_heartbeats(0) == 0
