"""Mutants of small sources: each kind is made, and a line stays where it is."""

import ast
from collections import Counter
from textwrap import dedent

import pytest

from mutation.edits import KINDS
from mutation.mutants import Mutant, draw, is_program, mutants

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
    return [one.after for one in mutants("a.py", dedent(source)) if one.kind == kind]


@pytest.mark.parametrize(
    ("kind", "source", "expected"),
    [
        ("comparison", "a < b", ["a <= b", "a >= b"]),
        ("comparison", "(a) == (b)", ["(a) != (b)"]),
        ("comparison", "a is  not b", ["a is b"]),
        ("comparison", "a not in b", ["a in b"]),
        ("comparison", "0 < a <= b", ["0 <= a <= b", "0 >= a <= b", "0 < a < b", "0 < a > b"]),
        ("sign", "a - (b)", ["a + (b)"]),
        ("sign", "a*b", ["a/b"]),
        ("sign", "a += b", ["a -= b"]),
        ("sign", "f(-a)", ["f((a))"]),
        ("constant", "a = 7", ["a = 8", "a = 6"]),
        ("constant", "a = 0", ["a = 1"]),
        ("constant", "a = 0.5", ["a = 1.0", "a = 0.25"]),
        ("constant", "a = True", ["a = False"]),
        ("constant", "a = 'text'", []),
        ("call", "a.append(b)", ["pass"]),
        ("call", "a = sorted(b)", ["a = (b)"]),
        ("call", "a = f(b)", []),
        ("branch", "if a: b", ["if False: b", "if True: b"]),
        ("branch", "a if b else c", ["(a)", "(c)"]),
        ("branch", "a and b", ["((b))", "((a))", "((a) or (b))"]),
        ("branch", "not a", ["(a)"]),
        ("branch", "[a for a in b if a]", ["[a for a in b if True]"]),
        ("branch", "for a in b: break", ["for a in b: pass"]),
        ("extreme", "min(a)", ["max(a)"]),
        ("extreme", "a.maximum.reduce(b)", ["a.minimum.reduce(b)"]),
        ("extreme", "np.floor(a)", ["np.ceil(a)"]),
        ("extreme", "any(a)", ["all(a)"]),
    ],
)
def test_each_kind_is_made(kind: str, source: str, expected: list[str]) -> None:
    assert found(source, kind) == expected


def test_every_mutant_is_another_program_of_as_many_lines() -> None:
    every = mutants("a.py", SOURCE)
    assert set(KINDS) == {one.kind for one in every}
    for mutant in every:
        changed = mutant.apply(SOURCE)
        assert is_program(changed)
        assert ast.dump(ast.parse(changed)) != ast.dump(ast.parse(SOURCE))
        assert changed.count("\n") == SOURCE.count("\n")
        lines, other = SOURCE.splitlines(), changed.splitlines()
        differing = [n for n in range(len(lines)) if lines[n] != other[n]]
        assert {mutant.line <= n + 1 <= mutant.last_line for n in differing} == {True}


def test_types_docstrings_and_decorators_are_left_alone() -> None:
    changed = {one.line for one in mutants("a.py", SOURCE)}
    assert changed.isdisjoint({1, 3, 12, 21})
    assert not found("a: Literal[1, 2]", "constant")
    assert not found("def f(a: Literal[1]) -> Literal[2]: ...", "constant")
    assert not found("@cache(3)\ndef f(): ...", "constant")
    assert not found("if TYPE_CHECKING:\n    a = 3", "constant")


def test_a_mutant_says_where_it_is_and_whether_it_runs_at_import() -> None:
    def of(line: int) -> Mutant:
        return next(one for one in mutants("a.py", SOURCE) if one.line == line)

    assert (of(15).where, of(15).at_import) == ("Größe.clipped", False)
    assert (of(6).where, of(6).at_import) == ("", True)
    assert of(6).names == frozenset({"LIMIT"})
    default = of(14)
    assert (default.where, default.at_import) == ("Größe.clipped", True)
    assert default.names == frozenset({"clipped"})
    # A result that is kept is made by one test for all.
    assert of(23).at_import


def test_a_mutant_is_known_by_its_key_where_its_line_moves() -> None:
    moved = SOURCE.replace("\n\nclass", "\n\nOTHER = 1\n\n\nclass")
    moved = moved.replace("low: float = -1.0) -> float:", "low: float = -1.0) -> float:  # of one")
    keys = [one.key for one in mutants("a.py", SOURCE)]
    assert len(set(keys)) == len(keys)
    assert set(keys) < {one.key for one in mutants("a.py", moved)}


def test_a_seed_draws_the_same_mutants_of_all_kinds_alike() -> None:
    every = mutants("a.py", SOURCE)
    drawn = draw(every, 12, seed=3)
    assert drawn == draw(list(reversed(every)), 12, seed=3)
    assert drawn != draw(every, 12, seed=4)
    assert len(set(drawn)) == 12
    counts = Counter(one.kind for one in drawn)
    assert max(counts.values()) <= 3
    assert len(draw(every, 10_000, seed=1)) == len(every)
