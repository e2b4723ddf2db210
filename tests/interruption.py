"""Run one of the programs, and interrupt it while it starts or works."""

import os
import signal
import subprocess
import sys
import time
from contextlib import suppress

from amount import amount

MOMENTS = int(os.environ.get("OCC_INTERRUPTS", amount(3, 5)))
"""Moments at which each command is interrupted."""

# Delays count from the moment at which the program handles Ctrl-C, not the starting interpreter.
PROGRAM = """
import os, signal, sys

real, pipe = signal.signal, int(sys.argv.pop(1))
def listen(number, answer):
    before = real(number, answer)
    signal.signal = real
    os.write(pipe, b"x")
    return before
signal.signal = listen

from {module} import main
if __name__ == "__main__":
    sys.exit(main())
"""


def run_and_interrupt(
    module: str, words: list[str], delay: float, inherited: signal.Handlers = signal.SIG_DFL
) -> tuple[int, str]:
    """Run the main function of a module, and interrupt all its processes, as a terminal does.

    Parameters
    ----------
    module
        The module with the function ``main``.
    words
        The command line.
    delay
        Seconds from the moment at which the program handles Ctrl-C.
    inherited
        How the process that starts the program handles Ctrl-C.

    Returns
    -------
    tuple
        The exit code, and the text on standard error.
    """
    reader, writer = os.pipe()
    running = subprocess.Popen(
        [sys.executable, "-c", PROGRAM.replace("{module}", module), str(writer), *words],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        pass_fds=[writer],
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, inherited),
    )
    try:
        os.close(writer)
        if inherited == signal.SIG_DFL:
            assert os.read(reader, 1) == b"x"
        time.sleep(delay)
        with suppress(ProcessLookupError):
            os.killpg(running.pid, signal.SIGINT)
        _, error = running.communicate(timeout=60)  # once no process has the pipe open
        deadline = time.monotonic() + 30
        while is_alive(running.pid):
            assert time.monotonic() < deadline, "a process still runs"
            time.sleep(0.01)
    finally:
        os.close(reader)
        with suppress(ProcessLookupError):
            os.killpg(running.pid, signal.SIGKILL)
    return running.returncode, error


def is_alive(group: int) -> bool:
    """Return whether a process group still has a process."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
