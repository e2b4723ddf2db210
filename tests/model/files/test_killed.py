"""What ends the program while it writes: whole files or none, and nothing hidden after the next."""

import errno
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import pytest

from occ_model.files import locking, writing
from occ_model.files.writing import write_whole, written_whole

PROGRAM = """
import os, sys
from pathlib import Path
import occ_model as occ

SCENE = occ.load_preset("phone-68us").replace(rows=40, columns=400)

def picture(folder):
    from occ_model.files.writing import write_image

    write_image(folder / "picture.png", occ.render(SCENE).image)

def film(folder):
    occ.write_video(occ.render_video(SCENE, 3), folder / "film.mkv")

def sketch(folder):
    from occ_model.boards.sketch import DEFAULT_BOARD, board_named
    from occ_model.boards.transmission import transmission
    from occ_model.figures.transmitter_files import write_transmitter_files

    write_transmitter_files(folder, transmission(SCENE, board_named(DEFAULT_BOARD)))

def main():
    kind, folder, last, end = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    real, done = Path.replace, []
    def replace(path, target):
        done.append(path)
        if len(done) == last:
            os.kill(os.getpid(), end)
        return real(path, target)
    Path.replace = replace
    globals()[kind](folder)

if __name__ == "__main__":
    main()
"""


def run(folder: Path, kind: str, last: int, end: int = signal.SIGKILL) -> int:
    """Run the program, which is ended where it would put its so-many-th file into its place."""
    command = [sys.executable, "-c", PROGRAM, kind, str(folder), str(last), str(int(end))]
    return subprocess.run(command, check=False, stdout=subprocess.DEVNULL).returncode


def shown(folder: Path) -> dict[str, bytes]:
    """Read the files of a folder that are not hidden."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name[0] != ".")
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


@pytest.mark.parametrize(
    ("kind", "last"),
    [
        ("film", 1),
        pytest.param("sketch", 3, marks=pytest.mark.whole),
    ],
)
def test_what_kill_9_leaves_is_whole_or_absent(tmp_path: Path, kind: str, last: int) -> None:
    program: dict[str, Callable[[Path], object]] = {}
    exec(PROGRAM, program)
    (tmp_path / "whole" / "it").mkdir(parents=True)
    program[kind](tmp_path / "whole" / "it")
    whole = shown(tmp_path / "whole" / "it")
    assert len(whole) >= last
    left = tmp_path / "left" / "it"
    left.mkdir(parents=True)
    for name in whole:
        (left / name).parent.mkdir(exist_ok=True)
        (left / name).write_bytes(b"old")
    assert run(left, kind, last) == -signal.SIGKILL
    found = shown(left)
    assert found.keys() == whole.keys()
    written = [name for name, content in found.items() if content != b"old"]
    assert len(written) == last - 1
    assert all(found[name] == whole[name] for name in written)
    assert len([*left.rglob(".*")]) == 1  # what was to take its place


def hidden(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.name[0] == "."]


@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_the_next_export_removes_what_an_ended_one_left(
    tmp_path: Path, end: signal.Signals
) -> None:
    assert run(tmp_path, "picture", 1, end) == -end
    (left,) = hidden(tmp_path)
    assert (tmp_path / left).stat().st_size > 1000
    for name in (".hidden", ".occ-notes", f"{left[:-5]}", f"x{left}"):  # of somebody else
        (tmp_path / name).write_bytes(b"kept")
    (tmp_path / f".occ-{'0' * 16}.png").symlink_to(tmp_path / ".hidden")
    (tmp_path / f".occ-{'1' * 16}.png").mkdir()
    os.mkfifo(tmp_path / f".occ-{'2' * 16}.png")
    others = {*hidden(tmp_path)} - {left}
    write_whole(tmp_path / "another.txt", b"new")
    assert {*hidden(tmp_path)} == others
    assert (tmp_path / ".hidden").read_bytes() == b"kept"


def test_no_export_removes_what_another_is_writing(tmp_path: Path) -> None:
    program = f"""
from pathlib import Path
from occ_model.files.writing import written_whole

with written_whole(Path({str(tmp_path / "slow.txt")!r})) as temporary:
    print(temporary.name, flush=True)
    input()
    temporary.write_bytes(b"whole")
"""
    command = [sys.executable, "-c", program]
    with subprocess.Popen(command, stdin=-1, stdout=-1, text=True) as slow:
        assert slow.stdout is not None
        name = slow.stdout.readline().strip()
        with written_whole(tmp_path / "own.txt") as own:
            write_whole(tmp_path / "quick.txt", b"quick")
            assert {*hidden(tmp_path)} == {name, own.name}
            own.write_bytes(b"own")
        slow.communicate("go on\n")
    assert slow.returncode == 0
    assert shown(tmp_path) == {"slow.txt": b"whole", "own.txt": b"own", "quick.txt": b"quick"}
    assert hidden(tmp_path) == []


def test_a_file_taken_for_left_over_before_it_was_locked_is_begun_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real, begun = locking.locked, list[str]()

    def late(file: BinaryIO) -> bool | None:
        if not begun:
            begun.append(*hidden(tmp_path))
            write_whole(tmp_path / "other.txt", b"other")  # another writer, just then
        return real(file)

    monkeypatch.setattr(writing, "locked", late)
    with written_whole(tmp_path / "file.txt") as temporary:
        assert hidden(tmp_path) == [temporary.name]
        assert temporary.name not in begun
        temporary.write_bytes(b"whole")
    assert shown(tmp_path) == {"file.txt": b"whole", "other.txt": b"other"}
    assert hidden(tmp_path) == []


def test_without_locks_files_are_written_and_none_is_taken_for_left_over(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_locks(_file: object) -> None:
        raise OSError(errno.ENOTSUP, os.strerror(errno.ENOTSUP))

    monkeypatch.setattr(locking, "take_lock", no_locks)
    with written_whole(tmp_path / "slow.txt") as temporary:
        write_whole(tmp_path / "quick.txt", b"quick")
        temporary.write_bytes(b"slow")
    assert shown(tmp_path) == {"slow.txt": b"slow", "quick.txt": b"quick"}
