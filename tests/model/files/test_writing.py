"""Files are written completely or not at all."""

import errno
import os
import stat
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from model.files.test_reading import make_link_to_device, make_pipe, make_socket

from occ_model.errors import OutputError, one_line
from occ_model.files.writing import (
    check_replaceable,
    make_folder,
    write_folder,
    write_image,
    write_whole,
)

IMAGE = np.random.default_rng(7).integers(0, 256, (13, 21), dtype=np.uint8)


def raise_disk_full(*_arguments: object, **_options: object) -> NoReturn:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def interrupt(*_arguments: object, **_options: object) -> NoReturn:
    raise KeyboardInterrupt


def write_half(path: Path, content: bytes) -> NoReturn:
    with path.open("wb") as file:
        file.write(content[: len(content) // 2])
    raise_disk_full()


STEPS: dict[str, tuple[object, str, object]] = {
    "open": (os, "open", raise_disk_full),
    "write": (Path, "write_bytes", write_half),
    "chmod": (Path, "chmod", raise_disk_full),
    "replace": (Path, "replace", raise_disk_full),
}


@pytest.fixture(params=STEPS)
def full(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Make the disk full at each step of writing in turn."""
    monkeypatch.setattr(*STEPS[request.param])
    yield
    monkeypatch.undo()


@pytest.mark.parametrize("before", [None, b"something longer than what comes"])
@pytest.mark.parametrize("content", [b"", b"x", bytes(range(256)) * 1000])
def test_a_file_contains_exactly_what_was_written(
    tmp_path: Path, before: bytes | None, content: bytes
) -> None:
    path = tmp_path / "file.bin"
    if before is not None:
        path.write_bytes(before)
    write_whole(path, content)
    assert path.read_bytes() == content
    assert list(tmp_path.iterdir()) == [path]


def test_a_full_disk_leaves_the_old_file_and_nothing_else(full: None, tmp_path: Path) -> None:
    path = tmp_path / "file.bin"
    path.write_text("old")
    with pytest.raises(OutputError) as refused:
        write_whole(path, b"new content")
    assert str(refused.value) == f"{path} cannot be written: No space left on device."
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interruption_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "file.bin"
    path.write_bytes(b"old")
    monkeypatch.setattr(Path, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_whole(path, b"new")
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def a_protected_file(path: Path) -> None:
    path.write_bytes(b"kept")
    path.chmod(0o444)


def a_link_to_a_protected_file(path: Path) -> None:
    a_protected_file(path.with_name("kept"))
    path.symlink_to(path.with_name("kept"))


def a_link_to_itself(path: Path) -> None:
    path.symlink_to(path)


def make_nothing(_path: Path) -> None:
    pass


NO_FILE = "is a device, pipe or socket; name a regular file to write to"
PROTECTED = "is write-protected; name another file, or allow writing to it"


@pytest.mark.parametrize("write", [lambda path: write_whole(path, b"x"), check_replaceable])
@pytest.mark.parametrize(
    ("name", "make", "why"),
    [
        ("x.png", Path.mkdir, "is a folder; name a file to write to"),
        ("x.png", make_pipe, NO_FILE),
        ("x.png", make_socket, NO_FILE),
        ("x.png", make_link_to_device, NO_FILE),
        ("x.png", a_protected_file, PROTECTED),
        ("x.png", a_link_to_a_protected_file, PROTECTED),
        ("x.png", a_link_to_itself, f"cannot be written: {os.strerror(errno.ELOOP)}"),
        (
            "no/x.png",
            make_nothing,
            "cannot be written: its folder does not exist; name one that does",
        ),
        ("x" * 300, make_nothing, f"cannot be written: {os.strerror(errno.ENAMETOOLONG)}"),
    ],
)
def test_what_a_file_cannot_replace_is_refused_and_unchanged(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    write: Callable[[Path], object],
    name: str,
    make: Callable[[Path], None],
    why: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / name
    make(path)
    before = {each.name: (each.lstat().st_ino, each.lstat().st_mode) for each in tmp_path.iterdir()}
    with pytest.raises(OutputError) as refused:
        write(path)
    assert str(refused.value) == f"{one_line(str(path))} {why}."
    after = {each.name: (each.lstat().st_ino, each.lstat().st_mode) for each in tmp_path.iterdir()}
    assert after == before
    if why == PROTECTED:
        assert path.read_bytes() == b"kept"


@pytest.mark.parametrize("there", [True, False], ids=["present", "missing"])
def test_a_symbolic_link_is_kept_and_its_target_is_written(tmp_path: Path, there: bool) -> None:
    (tmp_path / "elsewhere").mkdir()
    target = tmp_path / "elsewhere" / "file.bin"
    if there:
        target.write_bytes(b"old")
    (tmp_path / "near").symlink_to("elsewhere/file.bin")
    far = tmp_path / "far"
    far.symlink_to("near")
    write_whole(far, b"new")
    assert far.is_symlink()
    assert (tmp_path / "near").is_symlink()
    assert not target.is_symlink()
    assert target.read_bytes() == b"new"
    assert list(target.parent.iterdir()) == [target]


def test_a_read_only_folder_is_refused_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "file.png"
    assert check_replaceable(path) is None
    # Tests may run as administrator, who may write to any folder.
    monkeypatch.setattr(os, "access", lambda where, _mode: Path(where) != tmp_path)
    with pytest.raises(OutputError) as refused:
        check_replaceable(path)
    assert str(refused.value) == f"{path} cannot be written: {os.strerror(errno.EACCES)}."


@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002])
def test_a_new_file_has_default_permissions(tmp_path: Path, mask: int) -> None:
    before = os.umask(mask)
    try:
        write_whole(tmp_path / "file.bin", b"x")
        after = os.umask(mask)
    finally:
        os.umask(before)
    assert after == mask
    assert stat.S_IMODE((tmp_path / "file.bin").stat().st_mode) == 0o666 & ~mask


@pytest.mark.parametrize("mode", [None, 0o600, 0o640, 0o666])
def test_a_file_that_is_being_written_is_private(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, mode: int | None
) -> None:
    path = tmp_path / "private.toml"
    if mode is not None:
        path.write_bytes(b"old")
        path.chmod(mode)
    (tmp_path / "any").touch()
    wanted = stat.S_IMODE((tmp_path / "any").stat().st_mode) if mode is None else mode
    seen: list[tuple[int, int]] = []
    plain_write = Path.write_bytes

    def write_and_check(name: Path, content: bytes) -> int:
        status = name.stat()
        seen.append((stat.S_IMODE(status.st_mode), status.st_size))
        return plain_write(name, content)

    monkeypatch.setattr(Path, "write_bytes", write_and_check)
    write_whole(path, b"secret")
    monkeypatch.undo()
    assert seen == [(0o600, 0)]
    assert stat.S_IMODE(path.stat().st_mode) == wanted
    assert path.read_bytes() == b"secret"


@pytest.mark.parametrize("name", [b"caf\xe9.png", b"\xff\xfe.png", b"name\nline.png"])
def test_a_name_that_is_not_valid_text_is_written_to_and_shown(tmp_path: Path, name: bytes) -> None:
    path = tmp_path / os.fsdecode(name)
    write_image(path, IMAGE)
    assert [os.fsencode(file.name) for file in tmp_path.iterdir()] == [name]
    path.chmod(0o444)
    with pytest.raises(OutputError) as refused:
        write_image(path, IMAGE)
    assert str(refused.value).isprintable()
    str(refused.value).encode()


def test_an_impossible_path_is_refused_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(
        OutputError, match=r"a\\x00b cannot be written: no file can have this name\."
    ):
        write_whole(tmp_path / "a\0b", b"x")
    with pytest.raises(OutputError, match=r"a\\x00b cannot be made: no file can have this name\."):
        make_folder(tmp_path / "a\0b")


def test_a_new_folder_appears_only_with_all_of_its_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "parent" / "new"

    write_bytes = Path.write_bytes

    def write_one_only(path: Path, content: bytes) -> int:
        assert not folder.exists()
        if path.name == "b":
            raise_disk_full()
        return write_bytes(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", write_one_only)
        with pytest.raises(OutputError, match="new cannot be made: No space left on device"):
            write_folder(folder, {"a": b"1", "b": b"2"})
    assert [*folder.parent.iterdir()] == []
    write_folder(folder, {"a": b"1", "b": b"2"})
    write_folder(folder, {"b": b"3"})
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {"a": b"1", "b": b"3"}
    assert [*folder.parent.iterdir()] == [folder]


def test_what_killed_programs_left_is_removed_once_it_is_old(tmp_path: Path) -> None:
    names = (".occ-0123456789abcdef.png", ".occ-0123456789abcdef", ".occ-notes", "old.png")
    for name in names:
        (tmp_path / name).touch()
    write_whole(tmp_path / "a.txt", b"")
    assert len([*tmp_path.iterdir()]) == len(names) + 1
    two_days_ago = time.time() - 2 * 86_400
    for name in names:
        os.utime(tmp_path / name, (two_days_ago, two_days_ago))
    write_whole(tmp_path / "a.txt", b"")
    assert {path.name for path in tmp_path.iterdir()} == {".occ-notes", "old.png", "a.txt"}
