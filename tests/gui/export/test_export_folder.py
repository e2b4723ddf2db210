"""The next export removes the temporary files of one that was killed, and nothing else."""

import stat
import subprocess
import sys
from pathlib import Path

from occ_gui.export.jobs import (
    ExportJob,
    export,
    folder_aside,
    remove_left_behind,
)

PROJECT = Path(__file__).resolve().parents[3]

KILLED = """
import os, signal, sys
from pathlib import Path
from occ_gui.export.jobs import folder_aside

with folder_aside(Path(sys.argv[1])) as aside:
    (aside / "profile.png").write_bytes(b"half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_what_a_killed_export_left_is_removed_by_the_next(tmp_path: Path) -> None:
    command = [sys.executable, "-c", KILLED, str(tmp_path)]
    assert subprocess.run(command, cwd=PROJECT, check=False).returncode == -9
    assert len(list(tmp_path.glob(".export-*"))) == 2  # a folder and its lock
    (tmp_path / ".export-ab12_xyz").mkdir()  # as they were called once, without a lock
    (tmp_path / "figure.png").write_bytes(b"whole")
    export(ExportJob((), folder=tmp_path))
    assert [path.name for path in tmp_path.iterdir()] == ["figure.png"]


def test_what_is_at_work_stays_unread_by_others_and_is_gone_at_its_end(tmp_path: Path) -> None:
    with folder_aside(tmp_path) as aside:
        (aside / "profile.png").write_bytes(b"half")
        export(ExportJob((), folder=tmp_path))
        assert (aside / "profile.png").read_bytes() == b"half"
    assert list(tmp_path.iterdir()) == []
    names = set()
    for _ in range(10):
        with folder_aside(tmp_path) as aside:
            assert stat.S_IMODE(aside.stat().st_mode) == 0o700
            names.add(aside.name)
    assert len(names) == 10
    with folder_aside(tmp_path) as aside:
        aside.rmdir()
    assert list(tmp_path.iterdir()) == []


def test_what_is_somebody_elses_stays(tmp_path: Path) -> None:
    other = tmp_path / "elsewhere"
    other.mkdir()
    (other / "kept").write_text("kept")
    (tmp_path / ".export-aaaaaaaa").symlink_to(other)
    (tmp_path / ".export-bbbbbbbb" / "inner").mkdir(parents=True)
    (tmp_path / ".export-cccccccc").write_text("a file")
    (tmp_path / ".export-my-figures").mkdir()
    before = sorted(tmp_path.rglob("*"))
    remove_left_behind(tmp_path)
    assert sorted(tmp_path.rglob("*")) == before
