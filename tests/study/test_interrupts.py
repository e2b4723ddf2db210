"""Ctrl-C at any moment: one line, an exit code, and no process that lives on.

``OCC_INTERRUPTS=200`` does as many a command; every day it is some ten.
"""

import os
import re
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

MOMENTS = int(os.environ.get("OCC_INTERRUPTS", "8"))
"""Moments at which each command is interrupted."""

_LATEST = 1.6
"""Seconds after which the last moment is: workers are at work then."""

# The interpreter's own start answers Ctrl-C in its own way: we begin when ours is in place.
PROGRAM = """
import os, signal, sys

real, pipe = signal.signal, int(sys.argv.pop(1))
def listen(number, answer):
    before = real(number, answer)
    signal.signal = real
    os.write(pipe, b"x")
    return before
signal.signal = listen

from occ_model.cli import main
if __name__ == "__main__":
    sys.exit(main())
"""

COMMANDS = {
    "render": "render -o {folder}/x.png",
    "sweep": "sweep --vary iso=100:4000:1 --out {folder}/r.csv",
    "workers": "sweep --vary iso=100:4000:1 --jobs 2 --out {folder}/r.csv",
}


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("place", range(MOMENTS))
def test_an_interruption_is_one_line_and_leaves_no_process(
    tmp_path: Path, command: str, place: int
) -> None:
    words = COMMANDS[command].format(folder=tmp_path).split()
    code, error = interrupted(words, _LATEST * (place / MOMENTS) ** 2)
    text = re.sub(r"[^\n]*\r", "", error)  # the bar, drawn over itself
    lines = [line for line in text.splitlines() if line.strip()]
    if code == 0:  # it was done before
        assert command == "render"
        return
    assert (code, len([line for line in lines if line.startswith("occ-model: ")])) == (130, 1)
    assert [line for line in lines if not re.match(r"occ-model: |\s*\d+%\|", line)] == []
    kept = {path.name for path in tmp_path.iterdir()}
    assert kept <= {"x.png", "r.csv"}


def test_a_command_that_ignores_interruptions_goes_on_doing_so(tmp_path: Path) -> None:
    words = ["render", "--set", "rows=60", "-o", str(tmp_path / "x.png")]
    assert interrupted(words, 0.1, signal.SIG_IGN) == (0, "")


def interrupted(
    words: list[str], delay: float, inherited: signal.Handlers = signal.SIG_DFL
) -> tuple[int, str]:
    """Run a command, and interrupt it and all its processes, as a terminal does."""
    reader, writer = os.pipe()
    running = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(writer), *words],
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
        _, error = running.communicate(timeout=60)  # when nobody has its end of the pipe any more
        deadline = time.monotonic() + 30
        while is_alive(running.pid):
            assert time.monotonic() < deadline, "a process lives on"
            time.sleep(0.01)
    finally:
        os.close(reader)
        with suppress(ProcessLookupError):
            os.killpg(running.pid, signal.SIGKILL)
    return running.returncode, error


def is_alive(group: int) -> bool:
    """Say whether any process of a group is there."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
