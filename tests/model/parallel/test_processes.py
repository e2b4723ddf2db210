"""Start and end of worker processes, with Ctrl-C in between."""

import signal
import threading
from types import FrameType

import pytest
from worker_calls import echo

from occ_model.parallel.job import Job
from occ_model.parallel.process_pool import ProcessPool, delay_interrupts


def test_ctrl_c_is_handled_at_the_end() -> None:
    answered: list[int] = []

    def answer(number: int, _frame: FrameType | None) -> None:
        answered.append(number)

    before = signal.signal(signal.SIGINT, answer)
    try:
        with delay_interrupts():
            signal.raise_signal(signal.SIGINT)
            assert answered == []
        assert answered == [signal.SIGINT]
        assert signal.getsignal(signal.SIGINT) is answer
        with delay_interrupts():
            pass
        assert answered == [signal.SIGINT]
    finally:
        signal.signal(signal.SIGINT, before)


def test_another_thread_does_not_delay_ctrl_c() -> None:
    """Only the main thread may set signal handlers."""
    before = signal.getsignal(signal.SIGINT)
    seen: list[object] = []

    def hold() -> None:
        with delay_interrupts():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=hold)
    thread.start()
    thread.join()
    assert seen == [before]


def test_idle_workers_end_by_themselves_and_are_not_killed(monkeypatch: pytest.MonkeyPatch) -> None:
    # However long it takes on a busy machine.
    monkeypatch.setattr("occ_model.parallel.process_pool.EXIT_SECONDS", 60.0)
    pool = ProcessPool(2, "worker_calls")
    try:
        assert pool.submit(Job(echo, ("done",)), 0, 1).result(20.0).value == "done"
        started = pool.started_processes()
    finally:
        pool.close()
    assert started
    assert {process.exitcode for process in started} == {0}
