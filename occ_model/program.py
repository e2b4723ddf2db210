"""Run a program: standard streams, Ctrl-C, errors as sentences, exit codes.

Nothing slow is imported here, so that Ctrl-C ends with a sentence from the first moment.
"""

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from io import TextIOWrapper
from types import FrameType, TracebackType

from occ_model.errors import OccError, OutputError, one_line

TYPE_CHECKING = False  # as in ``typing``, which is slow to import
if TYPE_CHECKING:
    from typing import NoReturn, TextIO

EXIT_FAILURE = 1  # the command is valid, but no code was read or the work could not be finished
EXIT_MISUSE = 2  # the command is not valid
EXIT_INTERRUPTED = 130  # Ctrl-C ended the program: 128 plus the signal's number, as in shells
INTERRUPTED = "interrupted."  # the message of a program that Ctrl-C ended
_LONGEST_SENTENCE = 4000  # characters of a sentence on the terminal
_IMPORT = "<frozen importlib"  # start of the file name of Python's own import code


def run_program(
    name: str,
    prepare: Callable[[], Callable[[], int]],
    *,
    is_process: bool,
    is_window: bool = False,
) -> int:
    """Run a program; return its exit code, and report an error in one line on standard error.

    ``prepare`` imports what is needed, reads the command line and returns the work to do. Signals
    and streams of the process are changed only if it runs nothing else (``is_process``). A window
    may have no standard output, and Ctrl-C ends it at once until it installs its own handler.
    """
    if is_process:
        # The matrices are small: threads of linear algebra wait for each other longer than they
        # compute, on a busy machine a hundred times as long. NumPy reads the number at its import.
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        return _prepare_and_run(name, prepare, is_process=is_process, is_window=is_window)
    except KeyboardInterrupt:
        if is_process:
            ignore_interrupts()
        say(name, INTERRUPTED)
        return EXIT_INTERRUPTED
    except OccError as error:
        say(name, str(error))
        return EXIT_MISUSE
    except Exception as error:  # noqa: BLE001 - a traceback means nothing to a user
        return _say_failure(name, error)


def _prepare_and_run(
    name: str, prepare: Callable[[], Callable[[], int]], *, is_process: bool, is_window: bool
) -> int:
    try:
        if is_process:
            open_streams(needs_output=not is_window)
            interrupts = Interrupts(name, always_at_once=is_window)
        if isinstance(sys.stdout, TextIOWrapper):
            # Replace letters that the encoding lacks, as standard error does.
            sys.stdout.reconfigure(errors="replace")
        if sys.stdout is None and not is_window:
            raise OutputError("Standard output is closed; send it to a file or to the null device.")
        work = prepare()
        if is_process:
            interrupts.end_preparation()
        code = work()
        _flush_output()
    except SystemExit:
        _flush_output()
        raise
    finally:
        if is_process:
            ignore_interrupts()
    return code


def say(name: str, sentence: str) -> None:
    """Print a sentence on standard error, in one line, if it is open."""
    try:
        print(f"{name}: {one_line(sentence, _LONGEST_SENTENCE)}", file=sys.stderr, flush=True)  # noqa: T201 - what this is for
    except (OSError, ValueError):
        discard(sys.stderr)


def ignore_interrupts() -> None:
    """Ignore Ctrl-C from now on, as the program ends within a few milliseconds."""
    with suppress(ValueError):  # outside the main thread
        signal.signal(signal.SIGINT, signal.SIG_IGN)


class Interrupts:
    """The handling of Ctrl-C in a process.

    During preparation, and during any import, Ctrl-C ends the process at once: no work has begun,
    and an interrupted import may print anything. Later it raises ``KeyboardInterrupt``, unless
    ``always_at_once``. A process that was started to ignore Ctrl-C continues to ignore it.
    """

    def __init__(self, name: str, always_at_once: bool) -> None:
        self._name = name
        self._always_at_once = always_at_once
        self._is_prepared = False
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, self._handle_interrupt)
            self._report = sys.unraisablehook
            sys.unraisablehook = self._handle_unraisable

    def end_preparation(self) -> None:
        """Raise ``KeyboardInterrupt`` from now on."""
        self._is_prepared = True

    def _handle_interrupt(self, _signal: int, frame: FrameType | None) -> None:
        if self._always_at_once or not self._is_prepared or _is_importing(frame):
            self._leave()
        raise KeyboardInterrupt

    def _handle_unraisable(self, unraisable: "sys.UnraisableHookArgs") -> None:
        """End the process if Ctrl-C came while an object was deleted, which hides exceptions."""
        if issubclass(unraisable.exc_type, KeyboardInterrupt):
            self._leave()
        self._report(unraisable)

    def _leave(self) -> "NoReturn":
        # Not by print, which Ctrl-C may have interrupted.
        with suppress(OSError):
            os.write(2, f"{self._name}: {INTERRUPTED}\n".encode())
        os._exit(EXIT_INTERRUPTED)


def _is_importing(frame: FrameType | None) -> bool:
    while frame is not None:
        if frame.f_code.co_filename.startswith(_IMPORT):
            return True
        frame = frame.f_back
    return False


def open_streams(needs_output: bool) -> None:
    """Open the null device for closed standard streams, whose numbers the next file would get."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    if sys.stderr is None:
        sys.stderr = _null()
    if sys.stdout is None and not needs_output:
        sys.stdout = _null()


def _null() -> "TextIO":
    return open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123 - for as long as we run


def _flush_output() -> None:
    if sys.stdout is not None:
        sys.stdout.flush()


def discard(stream: "TextIO | None") -> None:
    """Discard a stream's buffered output, which Python would write at exit and fail again."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())  # type: ignore[union-attr]


def _say_failure(name: str, error: Exception) -> int:
    """Report an error that nothing else in the program has reported; return the exit code."""
    try:
        _flush_output()
    except (OSError, ValueError):
        discard(sys.stdout)
    if isinstance(error, BrokenPipeError):  # the reader of our output has closed it on purpose
        return EXIT_FAILURE
    if isinstance(error, MemoryError):
        say(name, "There is too little memory for this.")
    elif isinstance(error, OSError):
        reason = one_line(error.strerror or str(error))
        if error.filename is None:
            say(name, f"Writing or reading failed: {reason}.")
        else:
            file = one_line(os.fsdecode(error.filename))
            say(name, f"{file}: {reason}.")
    else:
        kind, text = type(error).__name__, one_line(" ".join(str(error).split()))
        say(name, f"A mistake in this program, {_place(error.__traceback__)}: {kind}: {text}.")
    return EXIT_FAILURE


def _place(trace: TracebackType | None) -> str:
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    if trace is None:
        return "at an unknown place"
    return f"line {trace.tb_lineno} of {os.path.basename(trace.tb_frame.f_code.co_filename)}"  # noqa: PTH119
