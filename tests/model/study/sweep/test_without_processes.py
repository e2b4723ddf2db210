"""Laws of a sweep where the system makes it hard, or impossible, to start processes."""

import errno
import multiprocessing
import multiprocessing.synchronize
import os
import subprocess
import sys
from pathlib import Path

import pytest

import occ_model as occ
from occ_model.results.sweep import SweepTable
from occ_model.scene.scene import Scene

AXES = {"distance": [0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0]}

PROGRAM = f"""
import sys
import occ_model as occ

if __name__ == "__main__":
    table = occ.sweep(occ.load_preset("phone-136us"), {AXES!r}, jobs=2)
    sys.stdout.writelines(table.csv())
"""


@pytest.fixture(scope="module")
def scene() -> Scene:
    return occ.load_preset("phone-136us")


@pytest.fixture(scope="module")
def table(scene: Scene) -> SweepTable:
    """The sweep in this process, which all others must give again."""
    return occ.sweep(scene, AXES)


@pytest.mark.whole
def test_a_long_path_of_the_temporary_folder_costs_no_workers(
    tmp_path: Path, table: SweepTable
) -> None:
    # A socket's path has at most 107 bytes, and a folder's name alone may have 255.
    folder = tmp_path / ("t" * 150)
    folder.mkdir()
    program = tmp_path / "sweep.py"
    program.write_text(PROGRAM, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-W", "error", program],
        env={**os.environ, "TMPDIR": str(folder)},
        capture_output=True,
        text=True,
        timeout=90,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout == "".join(table.csv())


def refuse_semaphores(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the system behave as where /dev/shm cannot be written to."""

    def refuse(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(multiprocessing.synchronize.SemLock, "__init__", refuse)


def test_without_processes_the_sweep_runs_here_and_says_so(
    scene: Scene, table: SweepTable, monkeypatch: pytest.MonkeyPatch
) -> None:
    refuse_semaphores(monkeypatch)
    with pytest.warns(RuntimeWarning) as warned:
        assert occ.sweep(scene, AXES, jobs=2) == table
    (sentence,) = [str(warning.message) for warning in warned]
    assert sentence.startswith("No processes can be started (")
    assert sentence.endswith("); this one does the sweep alone.")


def test_without_new_workers_this_process_does_the_rest(
    scene: Scene, table: SweepTable, monkeypatch: pytest.MonkeyPatch
) -> None:
    killed: list[int] = []

    def kill_once(done: int, _total: int, _left: float) -> None:
        if done and not killed:
            refuse_semaphores(monkeypatch)
            for worker in multiprocessing.active_children():
                worker.kill()
                killed.append(worker.pid or 0)

    with pytest.warns(RuntimeWarning, match=r"workers are gone .*; this process finishes it alone"):
        assert occ.sweep(scene, AXES, jobs=2, progress=kill_once) == table
    assert killed
