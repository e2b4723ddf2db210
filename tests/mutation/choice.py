"""Which tests a mutant is tried with, and in what order."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath

from mutation.mutants import Mutant
from mutation.reach import MeasuredTest, lines_naming

_MIRRORS = {"occ_model": "tests/model", "occ_gui": "tests/gui"}


@dataclass(frozen=True)
class Choice:
    """The tests of a mutant, the most promising first."""

    tests: tuple[MeasuredTest, ...]
    left_out: int
    """How many more reach the line, for which there is no time."""
    is_reached: bool
    """Whether any test is known to run the line."""

    @property
    def seconds(self) -> float:
        return sum(test.seconds for test in self.tests)


def folder_of_tests(file: str) -> str:
    """Return the folder of tests that repeats the folder of a source."""
    package, *folders = PurePosixPath(file).parent.parts
    return "/".join([_MIRRORS.get(package, "tests"), *folders])


def nearness(test: MeasuredTest, file: str) -> int:
    """Order tests by their names and folders: 0 is nearest."""
    stem = PurePosixPath(file).stem
    folder = folder_of_tests(file)
    here = str(PurePosixPath(test.file).parent)
    if PurePosixPath(test.file).stem == f"test_{stem}":
        return 0
    if here == folder:
        return 1
    return 2 if here.split("/")[:3] == folder.split("/")[:3] else 3


def choose(
    mutant: Mutant, tests: Iterable[MeasuredTest], sources: Mapping[str, str], seconds: float
) -> Choice:
    """Choose the tests that reach a mutant, up to some time.

    A line that runs as its file is imported, or whose result is kept, is reached by every test that
    runs a line with its names in it, or else by those near to it that run a line of its file. So is
    one that no test is seen to run: it may run in a thread or process that is not measured.
    """
    tests = list(tests)
    lines = range(mutant.line, mutant.last_line + 1)
    exact = [test for test in tests if test.runs(mutant.file, lines)]
    named = _users(mutant, tests, sources) if mutant.at_import else []
    near = [test for test in tests if mutant.file in test.lines and nearness(test, mutant.file) < 3]
    ranked: dict[str, tuple[int, MeasuredTest]] = {}
    for rank, some in enumerate((exact, named, near)):
        for test in some:
            ranked.setdefault(test.name, (rank, test))
    ordered = sorted(
        ranked.values(),
        key=lambda pair: (pair[0] == 2, nearness(pair[1], mutant.file), pair[1].seconds),
    )
    chosen: list[MeasuredTest] = []
    used = 0.0
    left_out = 0
    for rank, test in ordered:
        if not chosen or used + test.seconds <= seconds:
            chosen.append(test)
            used += test.seconds
        else:
            left_out += rank < 2
    return Choice(tuple(chosen), left_out, bool(exact or named))


def _users(
    mutant: Mutant, tests: Iterable[MeasuredTest], sources: Mapping[str, str]
) -> list[MeasuredTest]:
    """Return the tests that run a line with the names that a mutant's line makes."""
    naming = {file: lines_naming(text, mutant.names) for file, text in sources.items()}
    return [
        test
        for test in tests
        if any(lines and test.runs(file, lines) for file, lines in naming.items())
    ]
