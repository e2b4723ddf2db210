"""Try inputs at the doors in a process of their own: one that never ends takes only that down.

``python tests/hard_cases/attack/program.py FIRST DOOR=CASES...`` tries so many cases at each door,
from the seed FIRST on, and prints what came of them as JSON. Before each case it prints its door
and seed, so that the last line names the case that ended the process, if one did. With a single
case, ``SEED DOOR=1``, what falls is raised as it is.
"""

import json
import signal
import sys
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FrameType
from typing import NoReturn

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from hard_cases.attack.promise import Door, sentences_of

_MOST_FALLEN = 20  # cases that fall at a door, from which on no more are tried


class OutOfTime(BaseException):
    """A case takes too long."""


@dataclass
class Outcomes:
    """What came of the cases at a door: results, sentences, and what fell by its seed."""

    results: int = 0
    sentences: int = 0
    fallen: dict[int, str] = field(default_factory=dict)

    @property
    def cases(self) -> int:
        return self.results + self.sentences + len(self.fallen)


def doors() -> dict[str, Door]:
    """All doors by name."""
    from hard_cases.attack.doors.photos import FILMS, PHOTOS, RAW
    from hard_cases.attack.doors.scenes import CARRIERS, LESSONS_FILES, SCENES
    from hard_cases.attack.doors.shell import SHELL, WINDOW_SHELL
    from hard_cases.attack.doors.state import STATE
    from hard_cases.attack.doors.tables import TABLES
    from hard_cases.attack.doors.typed import TYPED

    all_of_them = (
        TYPED, SCENES, LESSONS_FILES, CARRIERS, TABLES, PHOTOS, RAW, FILMS, SHELL,
        WINDOW_SHELL, STATE,
    )  # fmt: skip
    return {door.name: door for door in all_of_them}


def attack(door: Door, seeds: range) -> Outcomes:
    """Try the inputs of some seeds at a door, each in an empty folder."""
    found = Outcomes()
    for seed in seeds:
        print(door.name, seed, flush=True)  # noqa: T201
        try:
            sentences = _sentences(door, seed)
        except (Exception, OutOfTime, SystemExit) as fault:
            if len(seeds) == 1:
                raise
            found.fallen[seed] = f"{type(fault).__name__}: {str(fault)[:600]} {place_of(fault)}"
        else:
            found.sentences += bool(sentences)
            found.results += not sentences
        if len(found.fallen) >= _MOST_FALLEN:
            break
    return found


def _sentences(door: Door, seed: int) -> list[str]:
    """Try a case; again, if its time went by while modules were imported, which are there then."""
    known = len(sys.modules)
    try:
        return _bounded(door, seed)
    except OutOfTime:
        if len(sys.modules) == known:
            raise
    return _bounded(door, seed)


def _bounded(door: Door, seed: int) -> list[str]:
    # Also the current folder, in which a name by chance would otherwise become a file.
    with (
        TemporaryDirectory(prefix="occ-attack-") as folder,
        chdir(folder),
        time_bound(door.patience),
    ):
        return sentences_of(door, seed, Path(folder))


def place_of(fault: BaseException) -> str:
    """Name the lines that an exception went through last."""
    trace, places = fault.__traceback__, []
    while trace is not None:
        places.append(f"{Path(trace.tb_frame.f_code.co_filename).name}:{trace.tb_lineno}")
        trace = trace.tb_next
    return f"({' < '.join(reversed(places[-4:]))})"


@contextmanager
def time_bound(seconds: float) -> Iterator[None]:
    """Raise within a case that takes too long; end the process where that does not end it."""

    def late(_signal: int, _frame: FrameType | None) -> NoReturn:
        raise OutOfTime(f"more than {seconds:g} s of processor time")

    signal.signal(signal.SIGPROF, late)
    signal.setitimer(signal.ITIMER_PROF, seconds, 0.5)
    signal.setitimer(signal.ITIMER_VIRTUAL, 5.0 * seconds)  # no handler: it ends the process
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)


def peak_megabytes() -> float:
    """Return the most memory that this process has had, and not what its parent had before it."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) / 1024
    raise AssertionError("this system does not give a process's peak memory")


def _main(first: int, asked: list[str]) -> None:
    known, report = doors(), {}
    for word in asked:
        name, _, cases = word.partition("=")
        report[name] = asdict(attack(known[name], range(first, first + int(cases))))
    print(json.dumps({"doors": report, "memory": peak_megabytes()}))  # noqa: T201


if __name__ == "__main__":
    _main(int(sys.argv[1]), sys.argv[2:])
