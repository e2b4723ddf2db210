"""Trying a mutant: tests that reach it are chosen and run in the copy; one should fail."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath

from mutation.copy_of_project import Copy
from mutation.mutants import Mutant
from mutation.reach import MeasuredTest, lines_naming

_MIRRORS = {"occ_model": "tests/model", "occ_gui": "tests/gui"}

KILLED, SURVIVED, UNREACHED, UNCLEAR = "killed", "survived", "unreached", "unclear"
_PATIENCE = 60.0
_SLOWER = 5.0

_PYTEST = [
    "-x", "-q", "--tb=line", "-p", "no:cacheprovider",
    # That plug-ins of pytest are imported already is known.
    "-W", "ignore::pytest.PytestAssertRewriteWarning",
]  # fmt: skip
_PASSED, _NOT_FOUND, _NO_TESTS, _TIMED_OUT = 0, 4, 5, 124


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


@dataclass(frozen=True)
class Outcome:
    result: str
    by: str
    """The first test that failed, or why the mutant counts as killed."""
    tried: int
    left_out: int


def tried(mutant: Mutant, source: str, choice: Choice, copy: Copy) -> Outcome:
    """Put a mutant into the copy, run its tests, and take it out again."""
    if not choice.tests:
        return Outcome(UNREACHED, "no test is known to reach it", 0, 0)
    names = [test.name for test in choice.tests]
    timeout = _PATIENCE + _SLOWER * choice.seconds
    copy.write(mutant.file, mutant.apply(source))
    try:
        code, printed = copy.pytest([*_PYTEST, *_named(names, copy)], timeout)
        if code == _NOT_FOUND:
            # Names of tests have values in them that the mutant may have changed.
            files = list(dict.fromkeys(test.file for test in choice.tests))
            code, printed = copy.pytest([*_PYTEST, *files], timeout + 10.0 * _PATIENCE)
    finally:
        copy.write(mutant.file, source)
    if code == _TIMED_OUT:
        # On a machine that is busy the tests may take as long without a mutant.
        code, _ = copy.pytest([*_PYTEST, *_named(names, copy)], timeout)
        result = UNCLEAR if code == _TIMED_OUT else KILLED
        return Outcome(result, "time", len(names), choice.left_out)
    if code in (_PASSED, _NO_TESTS):
        return Outcome(SURVIVED, "", len(names), choice.left_out)
    failed = re.findall(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", printed, re.MULTILINE)
    return Outcome(KILLED, failed[0] if failed else f"exit {code}", len(names), choice.left_out)


def passes_unchanged(test: str, copy: Copy) -> bool:
    """Tell whether a test that has killed a mutant passes without one."""
    code, _ = copy.pytest([*_PYTEST, *_named([test], copy)], 10.0 * _PATIENCE)
    return code == _PASSED


def _named(names: list[str], copy: Copy) -> list[str]:
    """Hand names over in a file: there may be more than a command line takes."""
    (copy.root.parent / "tests.txt").write_text("\n".join(names), encoding="utf-8")
    return [f"@{copy.root.parent / 'tests.txt'}"]
