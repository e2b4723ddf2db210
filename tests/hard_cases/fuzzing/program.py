"""Fuzz one target in a process of its own, which may crash or never end.

``python tests/hard_cases/fuzzing/program.py SEED TARGET=CASES`` tries a number of cases, beginning
with this seed, and prints the outcomes as JSON. Before each case it prints target and seed, so that
the last line names the case at which the process ended. The failure of a single case,
``SEED TARGET=1``, is raised as it is.
"""

import json
import signal
import sys
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from traceback import extract_tb
from types import FrameType
from typing import NoReturn

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from hard_cases.fuzzing.target import FuzzTarget, run_case

_MOST_FAILURES = 20  # failures after which no more cases are tried


class OutOfTime(BaseException):
    """A case takes too long."""


@dataclass
class Outcomes:
    """How many cases gave results and sentences, and the failures by seed."""

    results: int = 0
    sentences: int = 0
    failures: dict[int, str] = field(default_factory=dict)
    megabytes: float = 0.0  # the most memory that the process has had

    @property
    def cases(self) -> int:
        return self.results + self.sentences + len(self.failures)


def targets() -> dict[str, FuzzTarget]:
    """Return all targets by name."""
    from hard_cases.fuzzing.targets.photos import FILMS, PHOTOS, RAW
    from hard_cases.fuzzing.targets.scenes import EXPORTED, LESSON_FILES, SCENES
    from hard_cases.fuzzing.targets.shell import SHELL, WINDOW_SHELL
    from hard_cases.fuzzing.targets.state import STATE
    from hard_cases.fuzzing.targets.tables import TABLES
    from hard_cases.fuzzing.targets.typed import TYPED

    every = (
        TYPED, SCENES, LESSON_FILES, EXPORTED, TABLES, PHOTOS, RAW, FILMS, SHELL,
        WINDOW_SHELL, STATE,
    )  # fmt: skip
    return {target.name: target for target in every}


def fuzz(target: FuzzTarget, seeds: range) -> Outcomes:
    """Try the inputs of some seeds, each in an empty folder."""
    found = Outcomes()
    for seed in seeds:
        print(target.name, seed, flush=True)  # noqa: T201
        try:
            sentences = _run_without_imports(target, seed)
        except (Exception, OutOfTime, SystemExit) as fault:
            if len(seeds) == 1:
                raise
            found.failures[seed] = f"{type(fault).__name__}: {str(fault)[:600]} {place_of(fault)}"
        else:
            found.sentences += bool(sentences)
            found.results += not sentences
        if len(found.failures) >= _MOST_FAILURES:
            break
    return found


def _run_without_imports(target: FuzzTarget, seed: int) -> list[str]:
    """Run a case; run it again if it ran out of time while modules were imported."""
    known = len(sys.modules)
    try:
        return _run_bounded(target, seed)
    except OutOfTime:
        if len(sys.modules) == known:
            raise
    return _run_bounded(target, seed)


def _run_bounded(target: FuzzTarget, seed: int) -> list[str]:
    # Also the current folder, where a random name may become a file.
    with (
        TemporaryDirectory(prefix="occ-fuzzing-") as folder,
        chdir(folder),
        time_bound(target.patience),
    ):
        return run_case(target, seed, Path(folder))


def place_of(fault: BaseException) -> str:
    """Name the last lines that an exception passed through."""
    places = [
        f"{Path(each.filename).name}:{each.lineno}" for each in extract_tb(fault.__traceback__)
    ]
    return f"({' < '.join(reversed(places[-4:]))})"


@contextmanager
def time_bound(seconds: float) -> Iterator[None]:
    """Raise OutOfTime within a case that takes too long; end the process if the case goes on."""

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
    """Return the most memory that this process has had, without that of its parent before it."""
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) / 1024
    raise AssertionError("this system does not give a process's peak memory")


def _main(first: int, target_and_cases: str) -> None:
    name, _, cases = target_and_cases.partition("=")
    found = fuzz(targets()[name], range(first, first + int(cases)))
    found.megabytes = peak_megabytes()
    print(json.dumps(asdict(found)))  # noqa: T201


if __name__ == "__main__":
    _main(int(sys.argv[1]), sys.argv[2])
