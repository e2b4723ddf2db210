"""Mutants of small sources, and a small project with tests that some of them survive."""

import ast
from collections import Counter
from pathlib import Path

import pytest
from each_case import each_case

from mutation import trial
from mutation.copied import ROOT, Copy
from mutation.faults import KINDS, Mutant, draw, mutants
from mutation.ledger import Ledger, equivalents
from mutation.trial import KILLED, SURVIVED, UNREACHED, MeasuredFile, Outcome, choose, tried

SOURCE = '''\
"""A docstring with 3 numbers and a < b."""

from functools import cache

LIMIT: "tuple[int, 2]" = (
    5 *
    2
)


class Größe:
    """Nothing of this text < 3 is changed."""

    def clipped(self, value: float, low: float = -1.0) -> float:
        self.note(value)
        if value > low and not self.frozen:
            return min(value, LIMIT)
        return abs(value) if value is not None else 0.0


@cache
def table():
    return [one for one in range(3) if one]
'''


def found(source: str, kind: str) -> list[str]:
    """Return what mutants of a kind make of the lines that they change."""
    return [one.after for one in mutants("a.py", source) if one.kind == kind]


@each_case(
    [
        ("comparison", "a < b", ["a <= b", "a >= b"]),
        ("comparison", "a is  not b", ["a is b"]),
        ("comparison", "0 < a <= b", ["0 <= a <= b", "0 >= a <= b", "0 < a < b", "0 < a > b"]),
        ("sign", "a - (b)", ["a + b"]),
        ("sign", "a *= b", ["a /= b"]),
        ("sign", "f(-a)", ["f(a)"]),
        ("constant", "a = 7", ["a = 8", "a = 6"]),
        ("constant", "a = 0", ["a = 1"]),
        ("constant", "a = 0.5", ["a = 1.0", "a = 0.25"]),
        ("constant", "a = True", ["a = False"]),
        ("constant", "a = 'text'", []),
        ("call", "a.append(b)", ["pass"]),
        ("call", "a = sorted(b)", ["a = b"]),
        ("call", "a = f(b)", []),
        ("branch", "if a: b", ["if False:", "if True:"]),
        ("branch", "a if b else c", ["a", "c"]),
        ("branch", "a and b", ["b", "a", "a or b"]),
        ("branch", "not a", ["a"]),
        ("branch", "[a for a in b if a]", ["[a for a in b]"]),
        ("branch", "for a in b: break", ["pass"]),
        ("extreme", "a.maximum.reduce(b)", ["a.minimum.reduce(b)"]),
        ("extreme", "any(a)", ["all(a)"]),
    ]
)
def test_each_kind_is_made(kind: str, source: str, expected: list[str]) -> None:
    assert found(source, kind) == expected


def test_every_mutant_is_another_program_with_a_key_of_its_own() -> None:
    every = list(mutants("a.py", SOURCE))
    assert set(KINDS) == {one.kind for one in every}
    assert len({one.key for one in every}) == len(every)
    for mutant in every:
        assert mutant.is_program(SOURCE)
        changed = mutant.apply(SOURCE)
        assert ast.dump(ast.parse(changed)) != ast.dump(ast.parse(SOURCE))
        assert mutant.after in changed
    assert {one.where for one in every} == {"", "Größe.clipped", "table"}


def test_types_docstrings_and_decorators_are_left_alone() -> None:
    changed = {one.lines.start for one in mutants("a.py", SOURCE)}
    assert changed.isdisjoint({1, 3, 12, 21})
    assert not found("a: Literal[1, 2]", "constant")
    assert not found("def f(a: Literal[1]) -> Literal[2]: ...", "constant")
    assert not found("@cache(3)\ndef f(): ...", "constant")
    assert not found("if TYPE_CHECKING:\n    a = 3", "constant")


def test_a_seed_draws_the_same_mutants_of_all_kinds_alike() -> None:
    every = list(mutants("a.py", SOURCE))
    drawn = draw(every, 12, seed=3)
    assert drawn == draw(every, 12, seed=3)
    assert drawn != draw(every, 12, seed=4)
    assert max(Counter(one.kind for one in drawn).values()) <= 3
    assert len(draw(every, 10_000, seed=1)) == len(every)


SIZES = "occ_model/sizes.py"
SIZES_SOURCE = """\
LIMIT = 3


def is_small(number):
    while number > 100:
        number -= 1
    return number < LIMIT
"""
TESTS = """\
from occ_model.sizes import is_small


def test_a_one_is_small():
    assert is_small(1)


def test_a_thousand_is_not():
    assert not is_small(1000)


def test_what_always_fails():
    assert False
"""


@pytest.fixture
def copy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Copy:
    # The small project's tests need no plug-ins, which take long to start.
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    monkeypatch.setattr(trial, "CACHE", tmp_path / "cache")
    (tmp_path / "occ_model").mkdir()
    (tmp_path / "occ_model" / "__init__.py").touch()
    (tmp_path / SIZES).write_text(SIZES_SOURCE)
    (tmp_path / "test_sizes.py").write_text(TESTS)
    return Copy(tmp_path)


def mutant(after: str) -> Mutant:
    return next(one for one in mutants(SIZES, SIZES_SOURCE) if one.after == after)


def test_a_fault_that_a_test_sees_is_killed_and_another_survives(copy: Copy) -> None:
    tests = [trial.measured("test_sizes.py", copy)]
    assert tests[0].failing == ["test_sizes.py::test_what_always_fails"]
    assert {1, 5, 6, 7} <= set(tests[0].lines[SIZES])
    # A mutant of as many letters is not taken for the compiled one before it.
    for after, result in [
        ("return number <= LIMIT", Outcome(SURVIVED)),
        ("return number >= LIMIT", Outcome(KILLED, "test_sizes.py::test_a_one_is_small")),
    ]:
        choice = choose(mutant(after), tests, 60.0, copy)
        assert tried(mutant(after), choice, copy) == result
        assert (copy.root / SIZES).read_text() == SIZES_SOURCE
    unknown = mutant("LIMIT = 4")
    assert tried(unknown, choose(unknown, [], 60.0, copy), copy) == Outcome(UNREACHED)


@pytest.mark.whole
def test_a_loop_without_end_is_killed_unless_all_takes_as_long_without_it(
    copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trial, "_PATIENCE", 3.0)
    endless = mutant("number += 1")
    choice = choose(endless, [trial.measured("test_sizes.py", copy)], 60.0, copy)
    assert tried(endless, choice, copy) == Outcome(KILLED, "time")
    slow = "import time\nfrom test_sizes import *\ntime.sleep(60.0)\n"
    (copy.root / "test_slow.py").write_text(slow)
    slow_choice = trial.Choice([MeasuredFile("test_slow.py", "", 0.0, [], {}, {})], 0)
    assert tried(endless, slow_choice, copy) == Outcome(trial.UNCLEAR, "time")


def test_files_of_tests_are_chosen_by_the_line_and_ordered_by_nearness_and_use(copy: Copy) -> None:
    fault = mutant("return number <= LIMIT")
    source = {SIZES: trial._hash(copy.root / SIZES)}

    def of(name: str, *lines: int, seconds: float = 1.0) -> MeasuredFile:
        return MeasuredFile(name, "", seconds, [], {SIZES: list(lines)}, source)

    far = of("tests/physics/test_light.py", 7)
    package = of("tests/model/effects/test_noise.py", 7)
    folder = of("tests/model/test_errors.py", 7)
    user = of("tests/model/test_program.py", 6, 7, seconds=3.0)
    own = of("tests/model/test_sizes.py", 7, seconds=9.0)
    importing = of("tests/model/test_imports.py", 1, 4)
    files = [far, importing, package, folder, user, own]
    assert choose(fault, files, 60.0, copy).files == [own, user, folder, package, far]
    short = choose(fault, files, 12.5, copy)
    assert (short.files, short.left_out) == ([own, user], 3)
    # Where no line is seen to run, or the source has changed since, all that import it are tried.
    assert choose(fault, [importing], 60.0, copy).files == [importing]
    (copy.root / SIZES).write_text(f"\n{SIZES_SOURCE}")
    assert importing in choose(fault, files, 60.0, copy).files


def test_results_and_equivalents_make_the_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    every = list(mutants(SIZES, SIZES_SOURCE))
    ledger = Ledger(tmp_path / "results.jsonl")
    for result, one in zip([SURVIVED, KILLED, KILLED, UNREACHED], every, strict=False):
        ledger.note(one, Outcome(result), seed=1)
    ledger = Ledger(tmp_path / "results.jsonl")
    assert ledger.table()[1:] == [
        "| `occ_model/*.py` | 4 | 2 | 0 | 1 | 1 | 50 % |",
        "| all | 4 | 2 | 0 | 1 | 1 | 50 % |",
    ]
    monkeypatch.setattr("mutation.ledger.equivalents", lambda: {every[0].key: "it is one"})
    assert ledger.table()[-1] == "| all | 4 | 2 | 1 | 0 | 1 | 67 % |"


@pytest.mark.whole
def test_every_equivalent_is_still_a_mutant_of_its_file() -> None:
    keys = {
        mutant.key
        for file in {key[0] for key in equivalents()}
        for mutant in mutants(file, (ROOT / file).read_text(encoding="utf-8"))
    }
    assert equivalents().keys() <= keys
    assert all(len(reason) > 10 for reason in equivalents().values())
