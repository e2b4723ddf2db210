"""Scenes out of figures and tables that were exported: each carries its scene inside."""

import codecs
import html
import re
from pathlib import Path

from occ_model.errors import SceneFileError
from occ_model.provenance import scenes_in
from occ_model.scene import Scene

ENDINGS = (".png", ".svg", ".pdf", ".csv")
"""The endings of files that may carry a scene."""

_LARGEST = 256_000_000
"""Bytes of a file that is looked into."""

_SVG = re.compile(rb"<dc:description>(.*?)</dc:description>", re.DOTALL)
_PDF = re.compile(rb"/Subject \(((?:[^\\()]|\\.)*)\)", re.DOTALL)
_PDF_ESCAPE = re.compile(rb"\\([0-7]{1,3}|.)", re.DOTALL)
_ESCAPED = {b"n": b"\n", b"r": b"\r", b"t": b"\t", b"b": b"\b", b"f": b"\f"}


def scene_inside(path: Path) -> Scene:
    """Read the scene that an exported figure or table carries; of several the first.

    Parameters
    ----------
    path
        A PNG, SVG, PDF or CSV file that this package wrote.

    Raises
    ------
    SceneFileError
        It cannot be read, or carries no scene.
    ParameterError
        A value in it is out of range.
    """
    try:
        if path.stat().st_size > _LARGEST:
            raise SceneFileError(f"{path} is too large to carry a scene.")
        scenes = scenes_in(_text_inside(path.suffix.lower(), path.read_bytes()))
    except OSError as error:
        raise SceneFileError(f"{path} cannot be read: {error.strerror or error}.") from None
    except UnicodeDecodeError:
        scenes = {}
    if not scenes:
        raise SceneFileError(f"{path} carries no scene; figures and tables exported here do.")
    return next(iter(scenes.values()))


def _text_inside(ending: str, content: bytes) -> str:
    if ending == ".png":
        return _of_png(content)
    if ending == ".svg":
        found = _SVG.search(content)
        return html.unescape(found[1].decode("utf-8")) if found else ""
    if ending == ".pdf":
        found = _PDF.search(content)
        return _of_pdf(found[1]) if found else ""
    lines = content.decode("utf-8-sig").splitlines()
    return "\n".join(line[1:].removeprefix(" ") for line in lines if line.startswith("#"))


def _of_png(content: bytes) -> str:
    # Pillow is slow to import, and only needed when a picture is really opened.
    from io import BytesIO

    from PIL import Image

    try:
        with Image.open(BytesIO(content), formats=("PNG",)) as picture:
            return str(picture.info.get("Description", ""))
    except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files
        return ""


def _of_pdf(literal: bytes) -> str:
    """Read a PDF's literal string."""

    def plain(match: re.Match[bytes]) -> bytes:
        code = match[1]
        if code.isdigit():
            return bytes([int(code, 8) & 0xFF])
        return _ESCAPED.get(code, code)

    text = _PDF_ESCAPE.sub(plain, literal)
    if text.startswith(codecs.BOM_UTF16_BE):
        return text[2:].decode("utf-16-be")
    return text.decode("latin-1")
