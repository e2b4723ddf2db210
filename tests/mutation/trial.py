"""Trying a mutant: its tests run in the copy, and one of them should fail."""

import re
from dataclasses import dataclass

from mutation.choice import Choice
from mutation.copy_of_project import Copy
from mutation.mutants import Mutant

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
