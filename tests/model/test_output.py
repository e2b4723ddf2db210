"""Files are written whole or not at all."""

import errno
import io
import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra import numpy as arrays
from PIL import Image

from occ_model.errors import OutputError
from occ_model.output import write_image, write_whole

IMAGE = np.random.default_rng(7).integers(0, 256, (13, 21), dtype=np.uint8)


def full_disk(*_arguments: object, **_options: object) -> NoReturn:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def interrupt(*_arguments: object, **_options: object) -> NoReturn:
    raise KeyboardInterrupt


class _HalfWritten(io.BytesIO):
    """A file that takes half of what it is given."""

    def __init__(self, descriptor: int) -> None:
        super().__init__()
        self._descriptor = descriptor

    def write(self, content: Any) -> NoReturn:
        os.write(self._descriptor, content[: len(content) // 2])
        full_disk()

    def close(self) -> None:
        if not self.closed:
            os.close(self._descriptor)
        super().close()


@pytest.fixture(params=["fdopen", "write", "chmod", "replace"])
def full(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let the disk be full at each step of writing in turn."""
    match request.param:
        case "fdopen":
            monkeypatch.setattr(os, "fdopen", full_disk)
        case "write":
            monkeypatch.setattr(os, "fdopen", lambda descriptor, mode: _HalfWritten(descriptor))
        case step:
            monkeypatch.setattr(Path, step, full_disk)
    yield
    monkeypatch.undo()


@pytest.mark.parametrize("content", [b"", b"x", bytes(range(256)) * 1000])
def test_a_file_holds_exactly_what_was_to_be_written(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "file.bin"
    write_whole(path, content)
    assert path.read_bytes() == content
    assert list(tmp_path.iterdir()) == [path]


def test_a_file_that_was_there_is_replaced(tmp_path: Path) -> None:
    path = tmp_path / "file.bin"
    path.write_bytes(b"something longer than what comes")
    write_whole(path, b"new")
    assert path.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [path]


def test_a_name_alone_is_a_file_in_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_whole(Path("file.bin"), b"here")
    assert (tmp_path / "file.bin").read_bytes() == b"here"


def test_a_full_disk_leaves_the_old_file_and_nothing_else(full: None, tmp_path: Path) -> None:
    path = tmp_path / "file.bin"
    path.write_bytes(b"old")
    with pytest.raises(OutputError) as refused:
        write_whole(path, b"new content")
    assert str(refused.value) == f"{path} cannot be written: No space left on device."
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_full_disk_leaves_no_new_file(full: None, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"No space left on device\.$"):
        write_image(tmp_path / "picture.png", IMAGE)
    assert list(tmp_path.iterdir()) == []


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


def test_a_folder_is_not_written_over(tmp_path: Path) -> None:
    folder = tmp_path / "folder.png"
    folder.mkdir()
    for write in (lambda: write_whole(folder, b"x"), lambda: write_image(folder, IMAGE)):
        with pytest.raises(OutputError) as refused:
            write()
        assert str(refused.value) == f"{folder} is a folder; name a file to write to."
    assert list(tmp_path.iterdir()) == [folder]
    assert list(folder.iterdir()) == []


def test_a_missing_folder_is_not_made(tmp_path: Path) -> None:
    path = tmp_path / "missing" / "file.png"
    with pytest.raises(OutputError) as refused:
        write_image(path, IMAGE)
    assert str(refused.value) == f"{path} cannot be written: No such file or directory."
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002])
def test_a_new_file_has_the_permissions_that_new_files_get(tmp_path: Path, mask: int) -> None:
    before = os.umask(mask)
    try:
        write_whole(tmp_path / "file.bin", b"x")
        after = os.umask(mask)
    finally:
        os.umask(before)
    assert after == mask
    assert stat.S_IMODE((tmp_path / "file.bin").stat().st_mode) == 0o666 & ~mask


@pytest.mark.parametrize(
    ("ending", "format_name"),
    [("png", "PNG"), ("tif", "TIFF"), ("tiff", "TIFF"), ("bmp", "BMP"), ("PNG", "PNG")],
)
@given(image=arrays.arrays(np.uint8, arrays.array_shapes(min_dims=2, max_dims=2, max_side=9)))
def test_a_lossless_format_gives_the_pixels_back(
    tmp_path_factory: pytest.TempPathFactory, ending: str, format_name: str, image: np.ndarray
) -> None:
    path = tmp_path_factory.mktemp("lossless") / f"picture.{ending}"
    write_image(path, image)
    with Image.open(path) as read:
        assert read.format == format_name
        np.testing.assert_array_equal(np.asarray(read), image)


@pytest.mark.parametrize(
    ("ending", "format_name"),
    [("jpg", "JPEG"), ("jpeg", "JPEG"), ("JPG", "JPEG"), ("webp", "WEBP")],
)
def test_a_lossy_format_gives_the_picture_back(
    tmp_path: Path, ending: str, format_name: str
) -> None:
    image = np.tile(np.linspace(0, 255, 200).astype(np.uint8), (50, 1))
    write_image(tmp_path / f"picture.{ending}", image)
    with Image.open(tmp_path / f"picture.{ending}") as read:
        assert read.format == format_name
        difference = np.asarray(read.convert("L"), dtype=float) - image
    assert np.abs(difference).max() < 8


@pytest.mark.parametrize("name", ["x", "x.", "x.txt", "x.png.x", ".png", "x.gif", "x.pdf"])
def test_an_ending_of_no_image_format_is_refused_and_nothing_written(
    tmp_path: Path, name: str
) -> None:
    with pytest.raises(OutputError) as refused:
        write_image(tmp_path / name, IMAGE)
    assert str(refused.value) == (
        f"{name} has no ending of an image format; use .png, .jpg, .tif, .webp or .bmp."
    )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", ["webp", "jpg"])
@pytest.mark.parametrize("shape", [(1, 70_000), (70_000, 1)], ids=["wide", "tall"])
def test_a_picture_that_a_format_cannot_hold_is_refused_and_nothing_written(
    tmp_path: Path, ending: str, shape: tuple[int, int]
) -> None:
    with pytest.raises(OutputError, match=r"^picture\..* cannot be encoded as .*\.$"):
        write_image(tmp_path / f"picture.{ending}", np.zeros(shape, dtype=np.uint8))
    assert list(tmp_path.iterdir()) == []


def test_a_name_too_long_for_the_file_system_is_refused_in_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"):
        write_whole(tmp_path / ("a" * 300), b"content")
