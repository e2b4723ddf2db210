"""Prints the most bytes that some work has needed (on Linux): ``memory.py WHAT [ARGUMENT]``.

* ``picture PRESET``: a complete simulation, in bytes of its picture;
* ``film FILE``: how many frames of a film were read, up to 60, the last of which is from the film's
  end, and the bytes after a few of them and after all;
* ``growth``: the ratio of the bytes after 10,000 frames of a film to those after 1,000, simulated
  and decoded.

The bytes are those of this process and of the ones that it started: the decoder of films is one.
"""

import sys
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory

import occ_model as occ

_FEW, _MANY = 6, 59
_EARLY, _LATE = 1_000, 10_000


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


def of_picture(preset: str) -> None:
    scene = occ.load_preset(preset)
    occ.render(scene.replace(rows=200), tolerance=0.0)  # all that is loaded once is loaded now
    before = most_bytes()
    image = occ.render(scene, tolerance=0.0).image
    print((most_bytes() - before) / image.nbytes)


def of_film(path: str) -> None:
    taken = list(_after_each_frame(occ.load_video(path)))
    print(len(taken), taken[min(_FEW, len(taken)) - 1], taken[-1])


def _after_each_frame(film: occ.Video) -> Iterator[int]:
    for _ in islice(film, _MANY):
        yield most_bytes()
    if film.frame_count is not None and film.frame_count > _MANY:
        film.frame(film.frame_count - 1)
        yield most_bytes()


def of_growth() -> None:
    scene = occ.load_preset("phone-136us").replace(rows=240, columns=320, readout_time=25e-6)
    film = occ.render_video(scene, _LATE, settings=occ.SimulationSettings())
    simulated = _growth(film)
    with TemporaryDirectory() as folder:
        path = Path(folder, "film.mp4")
        occ.write_video(film, path)
        print(simulated, _growth(occ.load_video(path)))


def _growth(frames: Iterable[object]) -> float:
    run = iter(frames)
    for _ in islice(run, _EARLY):
        pass
    early = most_bytes()
    for _ in islice(run, _LATE - _EARLY):
        pass
    return most_bytes() / early


if __name__ == "__main__":
    what: dict[str, Callable[..., None]] = {
        "picture": of_picture, "film": of_film, "growth": of_growth
    }  # fmt: skip
    what[sys.argv[1]](*sys.argv[2:])
