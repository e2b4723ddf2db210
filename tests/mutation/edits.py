"""Faults: the places of a syntax tree where one can be put, and the text that it puts there."""

import ast
import math
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from io import StringIO
from itertools import pairwise
from tokenize import NAME, OP, generate_tokens

_COMPARISONS = {
    "<": ("<=", ">="),
    "<=": ("<", ">"),
    ">": (">=", "<="),
    ">=": (">", "<"),
    "==": ("!=",),
    "!=": ("==",),
    "is": ("is not",),
    "is not": ("is",),
    "in": ("not in",),
    "not in": ("in",),
}
_SIGNS = {"+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
_PAIRS = [
    ("min", "max"), ("minimum", "maximum"), ("fmin", "fmax"), ("nanmin", "nanmax"),
    ("argmin", "argmax"), ("nanargmin", "nanargmax"), ("floor", "ceil"), ("any", "all"),
]  # fmt: skip
_EXTREMES = dict(_PAIRS) | {second: first for first, second in _PAIRS}
# Calls of one value that can be left out without a change of its type.
_BARE = {"abs", "sorted", "round", "floor", "ceil", "sqrt", "square", "rint", "fabs"}


@dataclass(frozen=True)
class Edit:
    """Bytes of a source, and what takes their place."""

    start: int
    end: int
    text: bytes


class Source:
    """A source's text, and where its nodes and words are."""

    def __init__(self, text: str) -> None:
        self.bytes = text.encode()
        self.tree = ast.parse(self.bytes)
        lines = self.bytes.splitlines(keepends=True)
        self._starts = [0]
        for line in lines:
            self._starts.append(self._starts[-1] + len(line))
        self._words = [
            (self._starts[row - 1] + len(token.line[:column].encode()), token.string)
            for token in generate_tokens(StringIO(text).readline)
            if token.type in (OP, NAME) and "\n" not in token.line[:-1]
            for row, column in (token.start,)
        ]
        self._word_starts = [start for start, _ in self._words]

    def span(self, node: ast.expr | ast.stmt) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return (
            self._starts[node.lineno - 1] + node.col_offset,
            self._starts[node.end_lineno - 1] + node.end_col_offset,
        )

    def of(self, node: ast.expr) -> bytes:
        """Return the text of a node, in parentheses as it may stand anywhere."""
        start, end = self.span(node)
        return b"(" + self.bytes[start:end] + b")"

    def operator(self, left: ast.expr, right: ast.expr) -> tuple[int, int, str] | None:
        """Find the operator between two nodes: start, end, and its words."""
        first = bisect_left(self._word_starts, self.span(left)[1])
        last = bisect_left(self._word_starts, self.span(right)[0])
        words = [(start, word) for start, word in self._words[first:last] if word not in "()"]
        if not words:
            return None
        start, end = words[0][0], words[-1][0] + len(words[-1][1])
        return start, end, " ".join(word for _, word in words)

    def replaced(self, node: ast.expr, text: bytes) -> Edit:
        """Put a text in an expression's place, without a change of the number of lines."""
        start, end = self.span(node)
        missing = self.bytes.count(b"\n", start, end) - text.count(b"\n")
        # Only parentheses let an expression go over lines.
        padded = b"(" + text + b"\n" * missing + b")" if missing else text
        return Edit(start, end, padded)

    def dropped(self, statement: ast.stmt) -> Edit:
        """Put ``pass`` in a statement's place, without a change of the number of lines."""
        start, end = self.span(statement)
        return Edit(start, end, b"pass" + b"\n" * self.bytes.count(b"\n", start, end))


def comparisons(node: ast.AST, source: Source) -> Iterator[Edit]:
    """Move a limit by one, or turn a comparison round."""
    if isinstance(node, ast.Compare):
        for left, right in pairwise([node.left, *node.comparators]):
            if found := source.operator(left, right):
                start, end, words = found
                for other in _COMPARISONS.get(words, ()):
                    yield Edit(start, end, other.encode())


def signs(node: ast.AST, source: Source) -> Iterator[Edit]:
    """Swap plus and minus, times and divided by, or leave out a sign."""
    found = None
    if isinstance(node, ast.BinOp):
        found = source.operator(node.left, node.right)
    elif isinstance(node, ast.AugAssign):
        found = source.operator(node.target, node.value)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield source.replaced(node, source.of(node.operand))
    if found is not None and found[2] in _SIGNS:
        yield Edit(found[0], found[1], _SIGNS[found[2]].encode())


def constants(node: ast.AST, source: Source) -> Iterator[Edit]:
    """Change a number by one or to its double, or a truth value to the other one."""
    if not isinstance(node, ast.Constant):
        return
    value = node.value
    others: Sequence[object] = ()
    if isinstance(value, bool):
        others = (not value,)
    elif isinstance(value, int):
        others = (value + 1, value - 1) if value > 0 else (1,)
    elif isinstance(value, float) and math.isfinite(value):
        others = (2.0 * value, 0.5 * value) if value else (1.0,)
    for other in others:
        # A negative number in parentheses: it may stand behind a power or a dot.
        text = f"({other})" if str(other).startswith("-") else str(other)
        yield source.replaced(node, text.encode())


def calls(node: ast.AST, source: Source) -> Iterator[Edit]:
    """Leave out a call that is made for what it does, or one that rounds, sorts and the like."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
        yield source.dropped(node)
    elif isinstance(node, ast.Call) and len(node.args) == 1 and _name(node.func) in _BARE:
        (argument,) = node.args
        if not isinstance(argument, ast.Starred | ast.GeneratorExp):
            yield source.replaced(node, source.of(argument))


def branches(node: ast.AST, source: Source) -> Iterator[Edit]:
    """Never or always take a branch, leave out a part of a condition, or go on with a loop."""
    if isinstance(node, ast.If):
        yield source.replaced(node.test, b"False")
        yield source.replaced(node.test, b"True")
    elif isinstance(node, ast.IfExp):
        for part in (node.body, node.orelse):
            yield source.replaced(node, source.of(part))
    elif isinstance(node, ast.BoolOp):
        yield from _shorter_conditions(node, source)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield source.replaced(node, source.of(node.operand))
    elif isinstance(node, ast.comprehension):
        for test in node.ifs:
            yield source.replaced(test, b"True")
    elif isinstance(node, ast.Break | ast.Continue):
        yield source.dropped(node)


def _shorter_conditions(node: ast.BoolOp, source: Source) -> Iterator[Edit]:
    """Leave out each part of a condition, and swap ``and`` and ``or``."""
    word, other = (b" and ", b" or ") if isinstance(node.op, ast.And) else (b" or ", b" and ")
    texts = [source.of(value) for value in node.values]
    for left_out in range(len(texts)):
        kept = word.join(texts[:left_out] + texts[left_out + 1 :])
        yield source.replaced(node, b"(" + kept + b")")
    yield source.replaced(node, b"(" + other.join(texts) + b")")


def extremes(node: ast.AST, source: Source) -> Iterator[Edit]:
    """Swap the smallest and the largest, up and down, any and all."""
    if isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Load):
        name = _name(node)
        if name in _EXTREMES:
            end = source.span(node)[1]
            yield Edit(end - len(name), end, _EXTREMES[name].encode())


def _name(node: ast.expr) -> str:
    """Return the last part of a name, or nothing."""
    if isinstance(node, ast.Name):
        return node.id
    return node.attr if isinstance(node, ast.Attribute) else ""


KINDS: dict[str, Callable[[ast.AST, Source], Iterator[Edit]]] = {
    "comparison": comparisons,
    "sign": signs,
    "constant": constants,
    "call": calls,
    "branch": branches,
    "extreme": extremes,
}
"""The kinds of faults by name."""
