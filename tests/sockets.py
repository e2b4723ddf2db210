"""The sockets on which processes listen, read from Linux's ``/proc``."""

import os
import stat
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

_LISTENS = "0A"
_ACCEPTS = 0x10000
"""The flag of a socket of this computer that takes connections."""


def processes_of(session: int) -> list[int]:
    """Return the processes of a session, which its first process and all that it started share."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            words = (folder / "stat").read_text(encoding="utf-8", errors="replace")
            if int(words.rpartition(")")[2].split()[3]) == session:
                found.append(int(folder.name))
    return found


def find_open_sockets(process: int) -> list[str]:
    """Name the sockets of a process to which other users or computers can connect.

    A socket in a folder that only its user can enter does not count: the user's own programs can
    do more to the process anyway.
    """
    own = set(_sockets(process))
    return [*_internet(process, own), *_local(process, own)]


def _sockets(process: int) -> Iterator[str]:
    for entry in Path(f"/proc/{process}/fd").iterdir():
        with suppress(OSError):  # closed meanwhile
            target = os.readlink(entry)  # noqa: PTH115 - it leads to no file
            if target.startswith("socket:["):
                yield target[8:-1]


def _internet(process: int, own: set[str]) -> Iterator[str]:
    for kind in ("tcp", "tcp6", "udp", "udp6"):
        table = Path(f"/proc/{process}/net/{kind}")
        for line in table.read_text(encoding="ascii").splitlines()[1:] if table.exists() else ():
            cells = line.split()
            if cells[9] in own and (cells[3] == _LISTENS or kind.startswith("udp")):
                yield f"{kind} {cells[1]}"


def _local(process: int, own: set[str]) -> Iterator[str]:
    table = Path(f"/proc/{process}/net/unix").read_text(encoding="utf-8", errors="replace")
    for line in table.splitlines()[1:]:
        cells = line.split(maxsplit=7)
        if cells[6] in own and int(cells[3], 16) & _ACCEPTS:
            name = cells[7] if len(cells) > 7 else "without a name"
            if not _is_private(name):
                yield f"unix {name}"


def _is_private(name: str) -> bool:
    if not name.startswith("/"):  # of no file, which everybody may connect to
        return False
    status = Path(name).parent.stat()
    return stat.S_IMODE(status.st_mode) & 0o077 == 0 and status.st_uid == os.getuid()
