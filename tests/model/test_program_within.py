"""A program's streams and its handling of Ctrl-C, within the process of the tests."""

import os
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NoReturn

import pytest

from occ_model import plugins
from occ_model.errors import OccError
from occ_model.program import Interrupts, open_streams, run_program


class ProcessEnded(BaseException):
    """Raised in place of ending this process."""


@pytest.fixture
def writes(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, bytes]]:
    """Record what is written to descriptors; raise an exception in place of ending the process."""
    notes: list[tuple[int, bytes]] = []

    def end(code: int) -> NoReturn:
        raise ProcessEnded(code)

    monkeypatch.setattr(os, "_exit", end)
    monkeypatch.setattr(os, "write", lambda where, what: notes.append((where, what)))
    return notes


@pytest.fixture
def default_handler() -> Iterator[None]:
    """Handle Ctrl-C as in a new process, and restore the handlers afterwards."""
    before, hook = signal.signal(signal.SIGINT, signal.default_int_handler), sys.unraisablehook
    yield
    signal.signal(signal.SIGINT, before)
    sys.unraisablehook = hook


def ctrl_c(frame: Any = None) -> None:
    """Call the handler of Ctrl-C, as Python does between two instructions."""
    handler = signal.getsignal(signal.SIGINT)
    assert callable(handler)
    handler(signal.SIGINT, frame)


INTERRUPTED = [(2, b"own: interrupted.\n")]


def test_a_window_ends_at_once_during_its_work_too(
    default_handler: None, writes: list[tuple[int, bytes]]
) -> None:
    Interrupts("own", always_at_once=True).end_preparation()
    with pytest.raises(ProcessEnded, match="130"):
        ctrl_c()
    assert writes == INTERRUPTED


def frame_of(file: str, before: object = None) -> Any:
    return SimpleNamespace(f_code=SimpleNamespace(co_filename=file), f_back=before)


def test_an_import_that_is_interrupted_ends_the_process(
    default_handler: None, writes: list[tuple[int, bytes]]
) -> None:
    Interrupts("own", always_at_once=False).end_preparation()
    with pytest.raises(KeyboardInterrupt):
        ctrl_c(frame_of("work.py", frame_of("main.py")))
    with pytest.raises(ProcessEnded):
        ctrl_c(frame_of("slow.py", frame_of("<frozen importlib._bootstrap>", frame_of("main.py"))))
    assert writes == INTERRUPTED


def test_an_interruption_that_a_deletion_swallows_ends_the_process(
    default_handler: None, writes: list[tuple[int, bytes]]
) -> None:
    reports: list[object] = []
    sys.unraisablehook = reports.append
    Interrupts("own", always_at_once=False)
    other = SimpleNamespace(exc_type=ValueError)
    sys.unraisablehook(other)
    assert reports == [other]
    with pytest.raises(ProcessEnded):
        sys.unraisablehook(SimpleNamespace(exc_type=KeyboardInterrupt))
    assert writes == INTERRUPTED


def test_a_process_that_ignores_ctrl_c_goes_on_to_do_so(default_handler: None) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Interrupts("own", always_at_once=False)
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


@pytest.mark.parametrize("error", [None, OccError("It cannot be."), KeyboardInterrupt()])
def test_within_another_program_ctrl_c_stays_as_it_was(
    default_handler: None, error: BaseException | None, capsys: pytest.CaptureFixture[str]
) -> None:
    def work() -> int:
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
        if error is not None:
            raise error
        return 0

    codes = {type(None): 0, OccError: 2, KeyboardInterrupt: 130}
    assert run_program("own", lambda: work, is_process=False) == codes[type(error)]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert capsys.readouterr().err.count("\n") == (error is not None)


def test_a_process_of_its_own_ignores_ctrl_c_at_its_end(
    default_handler: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "3")
    handlers: list[object] = []

    def work() -> int:
        handlers.append(signal.getsignal(signal.SIGINT))
        return 5

    assert run_program("own", lambda: work, is_process=True) == 5
    assert handlers != [signal.default_int_handler]
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_a_window_needs_no_output(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    assert run_program("own", lambda: lambda: 0, is_process=False, is_window=True) == 0
    assert run_program("own", lambda: lambda: 0, is_process=False) == 2


def test_a_plug_in_of_no_package_has_a_name_all_the_same(
    offer_decoders: Callable[..., None],
) -> None:
    offer_decoders(own=len)
    said = [plugins.describe(plugins.DECODERS, name) for name in ("own", "missing")]
    assert [one.partition(" of the package ")[2] for one in said] == ["'?'", "'?'"]


@pytest.mark.parametrize("closed", [0, 1, 2])
def test_a_stream_that_is_closed_is_opened_to_the_null_device(
    monkeypatch: pytest.MonkeyPatch, closed: int
) -> None:
    """Otherwise the next file that is opened would be taken for it."""
    opened: list[str] = []

    def fstat(descriptor: int) -> None:
        if descriptor == closed:
            raise OSError

    with monkeypatch.context() as closing:
        closing.setattr(os, "fstat", fstat)
        closing.setattr(os, "open", lambda path, _flags: opened.append(path))
        open_streams(needs_output=True)
    assert opened == [os.devnull]


def nested() -> int:
    raise KeyError("a\nb")


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (OSError(28, "No space left"), "Writing or reading failed: No space left."),
        (OSError(2, "No such file", "a.png"), "a.png: No such file."),
        (OSError(5, "Input/output error", b"a\xff\n"), r"a\udcff\n: Input/output error."),
        (MemoryError(), "There is too little memory for this."),
        (
            None,
            "A mistake in this program, line {line} of test_program_within.py: KeyError: 'a\\nb'.",
        ),
    ],
)
def test_an_unforeseen_error_becomes_one_line_that_says_what_failed_and_where(
    error: Exception | None, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    def work() -> int:
        if error is not None:
            raise error
        return nested()

    assert run_program("own", lambda: work, is_process=False) == 1
    line = nested.__code__.co_firstlineno + 1
    assert capsys.readouterr().err == f"own: {said.format(line=line, file=Path(__file__).name)}\n"
