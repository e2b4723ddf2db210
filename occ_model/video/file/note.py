"""Read and write the note in a film's file that states what it shows and how it was made."""

import struct
from pathlib import Path
from uuid import UUID

from occ_model.files.reading import BoundedFile

_MARK = UUID("6f63635f-6d6f-4465-8c5f-66696c6d6e74").bytes  # precedes a note in MP4 and MKV files
_MAX_NOTE_BYTES = 1_000_000  # bytes of a note
_VOID = b"\xec"  # Matroska's element for bytes that players ignore


def mp4_note(note: str) -> bytes:
    """Return the box of type ``uuid`` with a note, for the end of an MP4 file."""
    content = _MARK + note.encode()
    return struct.pack(">I4s", 8 + len(content), b"uuid") + content


def mkv_note(note: str) -> bytes:
    """Return the element with a note, for the end of an MKV file."""
    content = _MARK + note.encode()
    # A size of eight bytes is marked by a leading 1.
    return _VOID + struct.pack(">Q", 1 << 56 | len(content)) + content


def read_note(path: Path) -> str:
    """Read the note of a film; empty if there is none or it cannot be read."""
    try:
        with path.open("rb") as file:
            start = file.read(16)
            if start[:4] in (b"GIF8", b"\x89PNG"):
                return _read_picture_note(path)
            file.seek(0, 2)
            file.seek(max(0, file.tell() - _MAX_NOTE_BYTES))
            end = file.read(_MAX_NOTE_BYTES)
    except OSError:
        return ""
    _before, mark, text = end.rpartition(_MARK)
    return text.decode(errors="replace") if mark else ""


def _read_picture_note(path: Path) -> str:
    from PIL import Image

    try:
        # Pillow reads up to the pixels, and limits the text that it unpacks.
        with BoundedFile(path) as file, Image.open(file, formats=("GIF", "PNG")) as picture:
            text = picture.info.get("Description", picture.info.get("comment", ""))
    except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files
        return ""
    text = text[:_MAX_NOTE_BYTES]
    return text.decode(errors="replace") if isinstance(text, bytes) else str(text)
