"""If the program is killed while writing, files are complete or absent."""

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

PROGRAM = """
import os, signal, sys
from pathlib import Path
import occ_model as occ

SCENE = occ.load_preset("phone-68us").replace(rows=40, columns=400)

def film(folder):
    occ.write_video(occ.render_video(SCENE, 3), folder / "film.mkv")

def sketch(folder):
    from occ_model.boards.sketch import DEFAULT_BOARD, board_named
    from occ_model.boards.transmission import prepare_transmission
    from occ_model.figures.transmitter_files import write_transmitter_files

    write_transmitter_files(folder, prepare_transmission(SCENE, board_named(DEFAULT_BOARD)))

def main():
    kind, folder, last = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])
    real, done = Path.replace, []
    def replace(path, target):
        done.append(path)
        if len(done) == last:
            os.kill(os.getpid(), signal.SIGKILL)
        return real(path, target)
    Path.replace = replace
    globals()[kind](folder)

if __name__ == "__main__":
    main()
"""


def run(folder: Path, kind: str, last: int) -> int:
    """Run the program and kill it as it would move its file of this number into place."""
    command = [sys.executable, "-c", PROGRAM, kind, str(folder), str(last)]
    return subprocess.run(command, check=False, stdout=subprocess.DEVNULL).returncode


def read_visible(folder: Path) -> dict[str, bytes]:
    """Read the visible files of a folder."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name[0] != ".")
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


@pytest.mark.parametrize(
    ("kind", "last"),
    [
        ("film", 1),
        pytest.param("sketch", 3, marks=pytest.mark.whole),
    ],
)
def test_files_are_complete_or_absent_after_signal_9(tmp_path: Path, kind: str, last: int) -> None:
    program: dict[str, Callable[[Path], object]] = {}
    exec(PROGRAM, program)
    (tmp_path / "whole" / "it").mkdir(parents=True)
    program[kind](tmp_path / "whole" / "it")
    whole = read_visible(tmp_path / "whole" / "it")
    assert len(whole) >= last
    left = tmp_path / "left" / "it"
    left.mkdir(parents=True)
    for name in whole:
        (left / name).parent.mkdir(exist_ok=True)
        (left / name).write_bytes(b"old")
    assert run(left, kind, last) == -signal.SIGKILL
    found = read_visible(left)
    assert found.keys() == whole.keys()
    written = [name for name, content in found.items() if content != b"old"]
    assert len(written) == last - 1
    assert all(found[name] == whole[name] for name in written)
    assert len([*left.rglob(".*")]) == 1  # the temporary file that would have replaced it
