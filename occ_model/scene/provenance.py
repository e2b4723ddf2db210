"""The provenance of a figure or table: its scenes, version and seed, stored in the file.

Time and memory for reading a file grow at most in proportion to its size, whatever is in it.
"""

import codecs
import html
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path

from occ_model.errors import SceneFileError, make_printable, one_line
from occ_model.files.reading import read_bytes, read_start
from occ_model.scene.scene import Scene
from occ_model.version import __version__

ENDINGS = (".png", ".svg", ".pdf", ".csv")  # endings of files that may contain a scene

_SCENE = re.compile(r"^scene (.+):$", re.MULTILINE)

_MAX_SEARCHED_BYTES = 64_000_000  # of a drawing or document, whose text may be anywhere
_MAX_TEXT_BYTES = 1_000_000  # of the text, and of the start of a picture or table that contains it
_SVG = b"<dc:description>", b"</dc:description>"
_COMMENTS = re.compile(rb"(?:#[^\n]*+\n?+)*+")
_PDF = b"/Subject ("
# Possessive quantifiers, so that no byte is matched twice.
_PDF_LITERAL = re.compile(rb"((?:[^\\()]++|\\.)*+)\)", re.DOTALL)
_PDF_ESCAPE = re.compile(rb"\\([0-7]{1,3}|.)", re.DOTALL)
_ESCAPED = {b"n": b"\n", b"r": b"\r", b"t": b"\t", b"b": b"\b", b"f": b"\f"}


@dataclass(frozen=True)
class Provenance:
    """The scenes, the version and the seed behind a figure or a table."""

    title: str
    scenes: Mapping[str, Scene]
    seed: int | None = None
    notes: tuple[str, ...] = field(default=())
    date: str = ""  # When the file was made; empty if it must not depend on the date

    def __post_init__(self) -> None:
        # Line breaks are removed, so that none of these can look like another line or a scene.
        object.__setattr__(self, "title", make_printable(self.title))
        object.__setattr__(self, "notes", tuple(map(make_printable, self.notes)))
        object.__setattr__(self, "date", make_printable(self.date))

    def lines(self) -> list[str]:
        lines = [self.title, f"occ_model {__version__}"]
        if self.date:
            lines.append(f"date {self.date}")
        if self.seed is not None:
            lines.append(f"seed {self.seed}")
        lines += self.notes
        for name, scene in self.scenes.items():
            lines += ["", f"scene {name}:", *scene.to_toml().splitlines()]
        return lines

    def text(self) -> str:
        return "\n".join(self.lines())


def first_scene_in(text: str) -> Scene | None:
    """Read the first scene in a text of :meth:`Provenance.text`; None if it has none."""
    start = _SCENE.search(text)
    if start is None:
        return None
    following = _SCENE.search(text, start.end())
    return Scene.from_toml(text[start.end() : following.start() if following else None])


def scene_inside(path: Path) -> Scene:
    """Read the first scene in an exported figure or table (PNG, SVG, PDF, CSV)."""
    where = one_line(str(path))
    try:
        text = _READERS[path.suffix.lower()](path)
    except UnicodeDecodeError:
        text = ""
    try:
        scene = first_scene_in(text)
    except SceneFileError as error:
        raise SceneFileError(f"{where} contains a scene that cannot be read. {error}") from None
    if scene is None:
        raise SceneFileError(
            f"{where} contains no scene; figures and tables that this program exports do."
        )
    return scene


def _text_in_png(path: Path) -> str:
    start = BytesIO(read_start(path, _MAX_TEXT_BYTES))
    # Pillow is slow to import, and needed only when a picture is opened.
    from PIL.PngImagePlugin import PngImageFile

    try:
        # Pillow reads only up to the pixels, and unpacks no more text than its own limits allow.
        with PngImageFile(start) as picture:
            return str(picture.info.get("Description", ""))
    except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files
        return ""


def _text_in_svg(path: Path) -> str:
    content = read_bytes(path, _MAX_SEARCHED_BYTES)
    start, end = _SVG
    first = content.find(start)
    last = content.find(end, first)
    if first < 0 or last < 0:
        return ""
    text = content[first + len(start) : min(last, first + _MAX_TEXT_BYTES)].decode("utf-8")
    try:
        return html.unescape(text)
    except ValueError:  # a character reference of thousands of digits
        return ""


def _text_in_csv(path: Path) -> str:
    comments = _COMMENTS.match(read_start(path, _MAX_TEXT_BYTES).removeprefix(codecs.BOM_UTF8))
    lines = comments[0].decode("utf-8").splitlines() if comments else []
    return "\n".join(line[1:].removeprefix(" ") for line in lines if line.startswith("#"))


def _text_in_pdf(path: Path) -> str:
    content = read_bytes(path, _MAX_SEARCHED_BYTES)
    place = content.find(_PDF)
    while place >= 0:
        place += len(_PDF)
        literal = _PDF_LITERAL.match(content, place, place + _MAX_TEXT_BYTES)
        if literal:
            return _literal_text(literal[1])
        # The search goes on after this start, so that no byte is searched twice.
        place = content.find(_PDF, place)
    return ""


def _literal_text(literal: bytes) -> str:
    def plain(match: re.Match[bytes]) -> bytes:
        code = match[1]
        if code.isdigit():
            return bytes([int(code, 8) & 0xFF])
        return _ESCAPED.get(code, code)

    text = _PDF_ESCAPE.sub(plain, literal)
    if text.startswith(codecs.BOM_UTF16_BE):
        return text[2:].decode("utf-16-be")
    return text.decode("latin-1")


_READERS = {".png": _text_in_png, ".svg": _text_in_svg, ".pdf": _text_in_pdf, ".csv": _text_in_csv}
