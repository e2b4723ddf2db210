"""Ctrl-C at any moment: one line, an exit code, and no process that lives on.

``OCC_INTERRUPTS=200`` does as many a command; every day it is three, with ``--whole`` five.
"""

import re
import signal
from pathlib import Path

import pytest
from interruption import MOMENTS, interrupted

_LATEST = 1.6
"""Seconds after which the last moment is: workers are at work then."""

MODULE = "occ_model.cli"

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
    code, error = interrupted(MODULE, words, _LATEST * (place / MOMENTS) ** 2)
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
    assert interrupted(MODULE, words, 0.1, signal.SIG_IGN) == (0, "")
