"""Count the scans of a JPEG, each of which its decoder takes over the whole picture."""

import re

_MARKER = re.compile(rb"\xff+([^\x00\x01\xd0-\xd7\xff])")
"""A marker that begins a segment: not a byte 255 of the data, nor a restart inside a scan."""

_END, _SCAN = b"\xd9", b"\xda"


def count_scans(content: bytes | bytearray, most: int, most_segments: int) -> int:
    """Count the scans of a JPEG as its decoder meets them, without decoding any.

    The number of scans; ``most + 1`` for more, or where there are too many segments.
    """
    scans, place = 0, 2
    for _ in range(most_segments):
        found = _MARKER.search(content, place)
        if found is None or found[1] == _END:
            return scans
        scans += found[1] == _SCAN
        if scans > most:
            return scans
        place = found.end() + int.from_bytes(content[found.end() : found.end() + 2], "big")
    return most + 1
