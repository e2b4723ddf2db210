"""If the program is killed while writing, files are complete or absent, and no leftovers stay."""

import errno
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import pytest

from occ_model.files import writing
from occ_model.files.writing import write_atomically, write_whole

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
    """Run the program and kill it as it would move its file of this number into place."""
    command = [sys.executable, "-c", PROGRAM, kind, str(folder), str(last), str(int(end))]
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


def list_hidden(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.name[0] == "."]


@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_the_next_export_removes_the_leftovers_of_a_killed_one(
    tmp_path: Path, end: signal.Signals
) -> None:
    assert run(tmp_path, "picture", 1, end) == -end
    (left,) = list_hidden(tmp_path)
    assert (tmp_path / left).stat().st_size > 1000
    for name in (".hidden", ".occ-notes", f"{left[:-5]}", f"x{left}"):  # files of others
        (tmp_path / name).write_bytes(b"kept")
    (tmp_path / f".occ-{'0' * 16}.png").symlink_to(tmp_path / ".hidden")
    (tmp_path / f".occ-{'1' * 16}.png").mkdir()
    os.mkfifo(tmp_path / f".occ-{'2' * 16}.png")
    others = {*list_hidden(tmp_path)} - {left}
    write_whole(tmp_path / "another.txt", b"new")
    assert {*list_hidden(tmp_path)} == others
    assert (tmp_path / ".hidden").read_bytes() == b"kept"


def test_an_export_does_not_remove_what_another_one_is_writing(tmp_path: Path) -> None:
    program = f"""
from pathlib import Path
from occ_model.files.writing import write_atomically

with write_atomically(Path({str(tmp_path / "slow.txt")!r})) as temporary:
    print(temporary.name, flush=True)
    input()
    temporary.write_bytes(b"whole")
"""
    command = [sys.executable, "-c", program]
    with subprocess.Popen(command, stdin=-1, stdout=-1, text=True) as slow:
        assert slow.stdout is not None
        name = slow.stdout.readline().strip()
        with write_atomically(tmp_path / "own.txt") as own:
            write_whole(tmp_path / "quick.txt", b"quick")
            assert {*list_hidden(tmp_path)} == {name, own.name}
            own.write_bytes(b"own")
        slow.communicate("go on\n")
    assert slow.returncode == 0
    assert read_visible(tmp_path) == {
        "slow.txt": b"whole",
        "own.txt": b"own",
        "quick.txt": b"quick",
    }
    assert list_hidden(tmp_path) == []


def test_a_file_removed_as_a_leftover_before_it_was_locked_is_created_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real, begun = writing.lock, list[str]()

    def lock_late(file: BinaryIO) -> bool | None:
        if not begun:
            begun.append(*list_hidden(tmp_path))
            write_whole(tmp_path / "other.txt", b"other")  # another writer at this moment
        return real(file)

    monkeypatch.setattr(writing, "lock", lock_late)
    with write_atomically(tmp_path / "file.txt") as temporary:
        assert list_hidden(tmp_path) == [temporary.name]
        assert temporary.name not in begun
        temporary.write_bytes(b"whole")
    assert read_visible(tmp_path) == {"file.txt": b"whole", "other.txt": b"other"}
    assert list_hidden(tmp_path) == []


def test_without_locks_files_are_written_and_none_is_taken_for_a_leftover(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse_lock(_file: object) -> None:
        raise OSError(errno.ENOTSUP, os.strerror(errno.ENOTSUP))

    monkeypatch.setattr(writing, "take_lock", refuse_lock)
    with write_atomically(tmp_path / "slow.txt") as temporary:
        write_whole(tmp_path / "quick.txt", b"quick")
        temporary.write_bytes(b"slow")
    assert read_visible(tmp_path) == {"slow.txt": b"slow", "quick.txt": b"quick"}
