"""Prints how many frames of a film were read, and the most bytes that this took (on Linux).

The bytes are those of this process and its decoder's together: after a few frames, and after up to
60 of them, the last of which is from the film's end.
"""

import sys
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import occ_model as occ

_FEW, _MANY = 6, 59


def most_bytes() -> int:
    """Add up the most memory that this process and those that it started have had."""
    own = Path("/proc/self")
    started = (own / "task" / own.resolve().name / "children").read_text(encoding="ascii").split()
    return sum(_peak(folder) for folder in (own, *(Path("/proc", number) for number in started)))


def _peak(process: Path) -> int:
    for line in (process / "status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) * 1024
    raise SystemExit("This system does not tell a process's peak memory.")


def read(film: occ.Video) -> Iterator[int]:
    """Read a film's frames; give the most bytes after each."""
    for _ in islice(film, _MANY):
        yield most_bytes()
    if film.frame_count is not None and film.frame_count > _MANY:
        film.frame(film.frame_count - 1)
        yield most_bytes()


if __name__ == "__main__":
    taken = list(read(occ.load_video(sys.argv[1])))
    print(len(taken), taken[min(_FEW, len(taken)) - 1], taken[-1])
