"""A killed sweep can be continued; an interruption prints one line and leaves no process.

``OCC_INTERRUPTS=200`` interrupts each command 200 times; by default it is once, with ``--whole``
five times.
"""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from itertools import product
from pathlib import Path

import pytest
from interruption import MOMENTS, is_alive, run_and_interrupt
from worker_calls import wait_until

from occ_model.results.sweep import SweepTable

SLOW = """
import sys
import occ_model as occ

def slow(path, jobs=2):
    scene = occ.load_preset("phone-136us").replace(rows=400, panel_height=0.05)
    axes = {"switching_frequency": [3e3, 14e3], "iso": list(range(100, 110))}
    return occ.sweep(scene, axes, 2, path="image", results=path, jobs=jobs)

if __name__ == "__main__":
    slow(sys.argv[1])
"""


@pytest.mark.whole
def test_a_sweep_killed_by_signal_9_can_be_continued_at_once_with_the_same_result(
    tmp_path: Path,
) -> None:
    program, path, whole = (tmp_path / name for name in ("sweep.py", "r.csv", "whole.csv"))
    program.write_text(SLOW)
    own: dict[str, Callable[[Path, int], SweepTable]] = {}
    exec(SLOW, own)
    own["slow"](whole, 1)
    command = [sys.executable, "-W", "ignore", str(program), str(path)]
    victim = subprocess.Popen(command, start_new_session=True)
    try:
        wait_until(lambda: path.exists() and path.read_bytes().count(b",threshold,") >= 4)
        victim.send_signal(signal.SIGKILL)
        victim.wait(30)
        assert 4 <= path.read_bytes().count(b",threshold,") < 20
        own["slow"](path, 1)
        assert path.read_text() == whole.read_text()
        wait_until(lambda: not is_alive(victim.pid))
    finally:
        with suppress(ProcessLookupError):
            os.killpg(victim.pid, signal.SIGKILL)


_LATEST = 1.6
"""Time of the last interruption in seconds, when the workers are busy."""

MODULE = "occ_model.cli"

COMMANDS = {
    "render": "render -o {folder}/x.png",
    "workers": "sweep --vary iso=100:4000:1 --jobs 2 --out {folder}/r.csv",
}

EVERYDAY = {("render", 1), ("workers", MOMENTS - 1)}


@pytest.mark.parametrize(
    ("command", "place"),
    [
        # By default each is interrupted once: a picture at its start, a sweep while workers run.
        pytest.param(*each, marks=() if each in EVERYDAY else pytest.mark.whole)
        for each in product(COMMANDS, range(MOMENTS))
    ],
)
def test_an_interruption_prints_one_line_and_leaves_no_process(
    tmp_path: Path, command: str, place: int
) -> None:
    words = COMMANDS[command].format(folder=tmp_path).split()
    code, error = run_and_interrupt(MODULE, words, _LATEST * (place / MOMENTS) ** 2)
    text = re.sub(r"[^\n]*\r", "", error)  # the progress bar, which is redrawn in place
    lines = [line for line in text.splitlines() if line.strip()]
    if code == 0:  # it finished earlier
        assert command == "render"
        return
    assert (code, len([line for line in lines if line.startswith("occ-model: ")])) == (130, 1)
    assert [line for line in lines if not re.match(r"occ-model: |\s*\d+%\|", line)] == []
    kept = {path.name for path in tmp_path.iterdir()}
    assert kept <= {"x.png", "r.csv"}


def test_a_command_started_to_ignore_interruptions_still_does(tmp_path: Path) -> None:
    words = ["render", "--set", "rows=60", "-o", str(tmp_path / "x.png")]
    assert run_and_interrupt(MODULE, words, 0.1, signal.SIG_IGN) == (0, "")
