"""A sweep that was killed is continued, even while workers of it are alive."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from occ_model.results.sweep import SweepTable

SLOW = """
import sys
import occ_model as occ
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

def slow(path, kind="alone"):
    scene = occ.load_preset("phone-136us").replace(rows=400, panel_height=0.05)
    axes = {"switching_frequency": [3e3, 14e3], "iso": list(range(100, 110))}
    executor = ProcessPoolExecutor(2, get_context("fork")) if kind == "forked" else None
    return occ.sweep(scene, axes, 2, path="image", results=path, executor=executor,
                     jobs=2 if kind == "own" else 1)

if __name__ == "__main__":
    slow(*sys.argv[1:])
"""


@pytest.fixture(scope="module")
def slow() -> Callable[[Path], SweepTable]:
    program: dict[str, Callable[[Path], SweepTable]] = {}
    exec(SLOW, program)
    return program["slow"]


@pytest.fixture(scope="module")
def slow_whole(slow: Callable[[Path], SweepTable], tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("whole") / "whole.csv"
    slow(path)
    return path.read_text()


@pytest.mark.whole
@pytest.mark.parametrize("kind", ["alone", "own", "forked"])
def test_what_kill_9_leaves_is_continued_at_once_and_ends_alike(
    tmp_path: Path, kind: str, slow: Callable[[Path], SweepTable], slow_whole: str
) -> None:
    program, path = tmp_path / "sweep.py", tmp_path / "r.csv"
    program.write_text(SLOW)
    command = [sys.executable, "-W", "ignore", str(program), str(path), kind]
    victim = subprocess.Popen(command, start_new_session=True)
    try:
        wait_for(lambda: path.exists() and path.read_bytes().count(b",threshold,") >= 4)
        victim.send_signal(signal.SIGKILL)
        victim.wait(30)
        assert 4 <= path.read_bytes().count(b",threshold,") < 20
        slow(path)  # while a given executor's forked workers may live on
        assert path.read_text() == slow_whole
        if kind == "own":
            wait_for(lambda: not is_alive(victim.pid))
    finally:
        with suppress(ProcessLookupError):
            os.killpg(victim.pid, signal.SIGKILL)


def is_alive(group: int) -> bool:
    """Say whether any process of a group is there."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def wait_for(happened: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 30
    while not happened():
        assert time.monotonic() < deadline
        time.sleep(0.01)
