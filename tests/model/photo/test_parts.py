"""However many parts, directories and numbers a file states, reading it ends within seconds."""

import io
import struct
from collections.abc import Callable
from itertools import chain
from pathlib import Path

import pytest
from photo_files import PICTURE, png_chunk, save
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from occ_model.errors import PhotoError
from occ_model.files import reading
from occ_model.files.reading import is_film
from occ_model.photo.reading import tiff
from occ_model.photo.reading.load import load_photo
from occ_model.photo.reading.raw import is_raw
from occ_model.video.file.note import read_note

SUB_DIRECTORIES, EXIF, ISO, ORIENTATION = 330, 0x8769, 0x8827, 274
SHORT, LONG, LONG8 = 3, 4, 16


def encoded(file_format: str) -> bytes:
    buffer = io.BytesIO()
    Image.new("L", (8, 8)).save(buffer, file_format)
    return buffer.getvalue()


def with_parts(
    file_format: str, before: bytes, part: bytes, back: int = 0
) -> Callable[[int], bytes]:
    """Put parts that say nothing into a file, before some bytes of it or a few earlier."""
    whole = encoded(file_format)
    place = whole.index(before, 2) - back
    return lambda count: whole[:place] + part * count + whole[place:]


PARTS: dict[str, Callable[[int], bytes]] = {
    "chunks.png": with_parts("PNG", b"IDAT", png_chunk(b"quIT", b""), 4),
    "last.png": with_parts("PNG", b"IEND", png_chunk(b"quIT", b""), 4),
    "data.png": with_parts("PNG", b"IEND", png_chunk(b"IDAT", b""), 4),
    "segments.jpg": with_parts("JPEG", b"\xff\xdb", b"\xff\xfe\0\2"),
    "padded.jpg": with_parts("JPEG", b"\xff\xdb", b"\xff"),
    "blocks.gif": with_parts("GIF", b",", b"!\xaa\1a\0"),
    "comment.gif": with_parts("GIF", b",", b"!\xfe\1a\1b\0"),
    "boxes.jp2": with_parts("JPEG2000", b"jp2h", b"\0\0\0\x08free", 4),
    "comments.ppm": with_parts("PPM", b"8 8", b"#\n"),
}


@pytest.mark.parametrize("name", PARTS)
def test_a_file_in_too_many_parts_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    path = tmp_path / name
    monkeypatch.setattr(reading, "MOST_READS", 1000)
    monkeypatch.setattr(reading, "MOST_BYTES_ONE_BY_ONE", 0)
    path.write_bytes(PARTS[name](20))
    assert load_photo(path).image.size == 64
    path.write_bytes(PARTS[name](1000))
    with pytest.raises(PhotoError, match=r" cannot be read: it is in more than 1,000 parts\.$"):
        load_photo(path)


def test_a_small_file_may_be_read_byte_by_byte(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    content = b"qoif" + struct.pack(">IIBB", 60, 60, 3, 0) + b"\x6a" * 3600 + bytes(7) + b"\1"
    (tmp_path / "x.qoi").write_bytes(content)
    monkeypatch.setattr(reading, "MOST_READS", 1000)
    assert load_photo(tmp_path / "x.qoi").image.size == 3600
    monkeypatch.setattr(reading, "MOST_BYTES_ONE_BY_ONE", len(content) - 1)
    with pytest.raises(PhotoError, match="in more than 1,000 parts"):
        load_photo(tmp_path / "x.qoi")


@pytest.mark.parametrize("name", ["chunks.png", "comment.gif"])
def test_a_film_or_its_note_in_too_many_parts_is_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    path, file_format = tmp_path / name, name[-3:].upper()
    frames = [Image.new("L", (8, 8), level) for level in (0, 200)]
    how = {"comment": "said"} if file_format == "GIF" else {"pnginfo": noted("said")}
    frames[0].save(path, save_all=True, append_images=frames[1:], **how)
    assert (is_film(path), read_note(path)) == (True, "said")
    monkeypatch.setattr(reading, "MOST_READS", 3)
    monkeypatch.setattr(reading, "MOST_BYTES_ONE_BY_ONE", 0)
    assert (is_film(path), read_note(path)) == (False, "")


def noted(text: str) -> PngInfo:
    notes = PngInfo()
    notes.add_text("Description", text)
    return notes


def directory(*entries: tuple[int, int, int, int], order: str = "<", big: bool = False) -> bytes:
    """Return a directory of a TIFF: tags with the kind, the number and the place of values."""
    counter, entry = ("Q", "HHQQ") if big else ("H", "HHLL")
    rows = b"".join(struct.pack(order + entry, *one) for one in entries)
    return struct.pack(order + counter, len(entries)) + rows + bytes(8 if big else 4)


def of_tiff(*entries: tuple[int, int, int, int], order: str = "<", big: bool = False) -> io.BytesIO:
    start = b"II" if order == "<" else b"MM"
    head = struct.pack(order + ("HHHQ" if big else "HL"), *((43, 8, 0, 16) if big else (42, 8)))
    return io.BytesIO(start + head + directory(*entries, order=order, big=big))


class Counted(io.BytesIO):
    """A file in memory that ends the program after a hundred reads."""

    reads = 0

    def read(self, size: int | None = -1, /) -> bytes:
        self.reads += 1
        if self.reads > 100:
            raise KeyboardInterrupt
        return super().read(size)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("big", [False, True])
def test_directories_that_name_each_other_are_read_once(order: str, big: bool) -> None:
    place = 16 if big else 8
    itself = (SUB_DIRECTORIES, LONG8 if big else LONG, 1, place)
    file = Counted(of_tiff(itself, order=order, big=big).getvalue())
    assert not is_raw(file)
    assert [[entry.tag for entry in one] for one in tiff.directories(file)] == [[SUB_DIRECTORIES]]


def test_no_more_directories_are_read_than_any_camera_writes() -> None:
    many = 100
    entry = (SUB_DIRECTORIES, LONG, many, 26)
    head = of_tiff(entry).getvalue()
    places = [26 + 4 * many + 6 * number for number in range(many)]
    empty = directory() * many
    file = Counted(head + struct.pack(f"<{many}L", *places) + empty)
    assert len(list(tiff.directories(file))) == 1 + 16
    repeated = Counted(of_tiff(*[entry] * 50).getvalue() + bytes(4 * many))
    assert len(list(tiff.directories(repeated))) <= 1 + 16


@pytest.mark.parametrize("cut", range(0, 40, 3))
def test_a_directory_that_is_cut_gives_its_whole_entries(cut: int) -> None:
    whole = of_tiff((1, SHORT, 1, 0), (SUB_DIRECTORIES, LONG, 1, 10**9)).getvalue()
    found = list(chain.from_iterable(tiff.directories(io.BytesIO(whole[:cut]))))
    assert [entry.tag for entry in found] == [1, SUB_DIRECTORIES][: max(0, (cut - 10) // 12)]


@pytest.mark.parametrize("big", [False, True])
def test_a_tiff_of_more_numbers_than_lines_is_refused(tmp_path: Path, big: bool) -> None:
    path = save(tmp_path, PICTURE, "x.tif", **({"big_tiff": True} if big else {}))
    content = bytearray(path.read_bytes())
    layout = struct.Struct("<HHQ" if big else "<HHL")
    place = min(content.find(layout.pack(273, kind, 1)) % 2**32 for kind in (SHORT, LONG, LONG8))
    for count in (4_000_000, 4_000_001):
        layout.pack_into(content, place, 273, LONG, count)
        path.write_bytes(content)
        words = "tags has too many numbers" if count > 4_000_000 else "damaged"
        with pytest.raises(PhotoError, match=words):
            load_photo(path)


def test_notes_of_more_numbers_than_any_camera_writes_are_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    exif = Image.Exif()
    exif.get_ifd(EXIF)[ISO] = (100,) * 20
    exif[ORIENTATION] = 6
    path = save(tmp_path, PICTURE, "x.png", exif=exif.tobytes())
    photo = load_photo(path, "columns")
    assert (photo.iso, photo.image.shape) == (100.0, PICTURE.size)
    monkeypatch.setattr(tiff, "MOST_NUMBERS", 19)
    photo = load_photo(path, "columns")
    assert (photo.iso, photo.image.shape) == (None, PICTURE.size[::-1])
