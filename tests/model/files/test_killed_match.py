"""Kill -9 at any step of a match of several photos: a whole table, or the one of before."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from PIL import Image

import occ_model as occ

SCENE = occ.load_preset("phone-68us").replace(
    rows=40, columns=600, pattern="10", switching_frequency=5e3, readout_time=9e-6,
    exposure_time=80e-6, panel_width=3.0, enhancement="none", averaging="light",
)  # fmt: skip

# It is killed before the so-many-th step that names the folder, however busy the machine is.
PROGRAM = """
import os, signal, sys

folder, last = sys.argv.pop(1), int(sys.argv.pop(1))
steps = []

def watch(event, given):
    if any(isinstance(one, (str, os.PathLike)) and os.fspath(one).startswith(folder)
           for one in given):
        steps.append(event)
        if len(steps) == last:
            os.kill(os.getpid(), signal.SIGKILL)

sys.addaudithook(watch)
from occ_model.cli import main
code = main()
print(*steps, file=sys.stderr)
raise SystemExit(code)
"""

PATIENCE_S = 60.0


@pytest.fixture
def photos(tmp_path: Path) -> list[Path]:
    """Write two photos that can be matched, and one that cannot be read."""
    for number in range(2):
        image = occ.render(SCENE.replace(start_time=number * 3e-5)).image
        Image.fromarray(image).save(tmp_path / f"{number}.png")
    (tmp_path / "damaged.png").write_bytes(b"no photo")
    return sorted(tmp_path.glob("*.png"))


def begin(photos: list[Path], out: Path, last: int) -> subprocess.Popen[bytes]:
    """Start to match photos, in a group of processes of its own, which is killed at a step."""
    words = ["match", *map(str, photos), "--led-frequency", "2.5kHz", "--out", str(out)]
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(out.parent), str(last), *words, "--jobs", "2"],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True,
    )  # fmt: skip


def wait_until_all_have_ended(group: int) -> None:
    """Wait until no process of a group is left."""
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.02)
    raise AssertionError("processes are left")


@pytest.mark.whole
def test_a_killed_match_leaves_a_whole_table_or_the_one_of_before(
    photos: list[Path], tmp_path: Path
) -> None:
    folder = tmp_path / "tables"
    folder.mkdir()
    process = begin(photos, folder / "table.csv", 0)
    _, said = process.communicate()
    assert process.returncode == 0
    steps = said.decode().splitlines()[-1].split()
    assert "os.rename" in steps
    whole = (folder / "table.csv").read_bytes()
    assert b"damaged.png,unreadable" in whole.replace(b'"', b"")
    for number in (1, len(steps) // 2 + 1, len(steps)):
        out = folder / f"{number}.csv"
        before = b"old" if number % 2 else None
        if before is not None:
            out.write_bytes(before)
        process = begin(photos, out, number)
        process.communicate()
        assert process.returncode == -signal.SIGKILL
        wait_until_all_have_ended(process.pid)
        left = out.read_bytes() if out.exists() else None
        assert left in (before, whole)
    assert {path.suffix for path in folder.iterdir() if path.name[0] != "."} == {".csv"}
