"""Regular files of a bounded size are read, and all others are refused."""

import os
import socket
from collections.abc import Callable
from pathlib import Path

import pytest

from occ_model.cli import main
from occ_model.errors import SceneFileError
from occ_model.files.reading import LARGEST_TEXT, read_bytes, read_start, read_text
from occ_model.scene.from_text import read_scene_file
from occ_model.scene.provenance import ENDINGS
from occ_model.scene.scene import Scene
from occ_model.teaching.lessons import read_lesson

posix = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no such files")


def make_pipe(path: Path) -> None:
    os.mkfifo(path)


def make_link_to_device(path: Path) -> None:
    path.symlink_to("/dev/zero")


def make_socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as listener:
        # A socket's path must be short, whatever the folder of the tests.
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            listener.bind(f"/proc/self/fd/{folder}/{path.name}")
        finally:
            os.close(folder)


NO_FILES = [make_pipe, make_link_to_device, make_socket]

limited = pytest.mark.parametrize("make", NO_FILES)


def test_a_file_is_read_whole_up_to_the_limit(tmp_path: Path) -> None:
    path = tmp_path / "file"
    content = os.urandom(3_000_000)
    path.write_bytes(content)
    assert read_bytes(path, 3_000_000) == content
    assert read_start(path, 2_500_000) == content[:2_500_000]
    with pytest.raises(SceneFileError) as refused:
        read_bytes(path, 2_999_999)
    assert str(refused.value) == f"{path} cannot be read: it has more than 2,999,999 bytes."


def test_reading_stops_at_the_limit_if_the_size_is_unknown(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    path = tmp_path / "endless"
    path.touch()
    asked: list[int] = []

    def read_endlessly(_descriptor: int, count: int) -> bytes:
        asked.append(count)
        return bytes(count)

    monkeypatch.setattr(os, "read", read_endlessly)
    with pytest.raises(SceneFileError, match="more than"):
        read_bytes(path, 5_000_000)
    assert sum(asked) == 5_000_001


def test_a_text_loses_only_its_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "text"
    path.write_text("µ\r\nx", encoding="utf-8-sig", newline="")
    assert read_text(path) == "µ\r\nx"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SceneFileError, match=r"cannot be read: it is not text in UTF-8\.$"):
        read_text(path)


@posix
@limited
def test_anything_but_a_regular_file_is_refused_at_once(
    tmp_path: Path, make: Callable[[Path], None]
) -> None:
    path = tmp_path / "thing"
    make(path)
    with pytest.raises(SceneFileError) as refused:
        read_bytes(path, 10)
    assert str(refused.value) == f"{path} cannot be read: it is a device, pipe or socket."


def test_a_folder_is_refused_as_one(tmp_path: Path) -> None:
    with pytest.raises(SceneFileError, match=r"cannot be read: it is a folder\.$"):
        read_bytes(tmp_path, 10)


@pytest.mark.parametrize("name", ["a\0b", "a" * 5000, "missing\n\x1b[31m"])
def test_an_impossible_name_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    with pytest.raises(SceneFileError) as refused:
        read_bytes(tmp_path / name, 10)
    assert str(refused.value).isprintable()
    assert len(str(refused.value)) < 300


@posix
def test_no_file_stays_open(tmp_path: Path) -> None:
    large = tmp_path / "large"
    large.write_bytes(b"xx")
    descriptors = Path("/proc/self/fd")
    before = sorted(descriptors.iterdir())
    for path in (large, tmp_path, tmp_path / "missing"):
        with pytest.raises(SceneFileError):
            read_bytes(path, 1)
    assert sorted(descriptors.iterdir()) == before


@posix
@limited
@pytest.mark.parametrize("ending", [".toml", *ENDINGS])
def test_every_reader_of_scenes_refuses_anything_but_a_regular_file(
    tmp_path: Path, make: Callable[[Path], None], ending: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"scene{ending}"
    make(path)
    with pytest.raises(SceneFileError, match="device, pipe or socket"):
        read_scene_file(path)
    with pytest.raises(SceneFileError, match="device, pipe or socket"):
        read_lesson(path)
    assert main(["plan", "--scene", str(path)]) == 2
    assert "device, pipe or socket" in capsys.readouterr().err


def test_a_scene_beyond_the_limit_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    text = Scene().to_toml()
    path.write_text(text + "#" * (LARGEST_TEXT - len(text)))
    assert read_scene_file(path) == Scene()
    os.truncate(path, 10**12)  # a hole, which takes no disk space
    with pytest.raises(SceneFileError, match="more than 1,000,000 bytes"):
        read_scene_file(path)
