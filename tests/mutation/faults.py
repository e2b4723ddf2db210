"""Mutants: sources with one fault in them, found in the syntax tree and drawn at random."""

import ast
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass
from random import Random

_Step = tuple[str, int | None]
"""From a node to one below it: the field, and the place in it where it is a list."""

_COMPARISONS: dict[type[ast.cmpop], Sequence[type[ast.cmpop]]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
_SIGNS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
_PAIRS = [
    ("min", "max"), ("minimum", "maximum"), ("fmin", "fmax"), ("nanmin", "nanmax"),
    ("argmin", "argmax"), ("nanargmin", "nanargmax"), ("floor", "ceil"), ("any", "all"),
]  # fmt: skip
_EXTREMES = dict(_PAIRS) | {second: first for first, second in _PAIRS}
# Calls of one value that can be left out without a change of its type.
_BARE = {"abs", "sorted", "round", "floor", "ceil", "sqrt", "square", "rint", "fabs"}


def comparisons(node: ast.AST) -> Iterator[ast.AST]:
    """Move a limit by one, or turn a comparison round."""
    if isinstance(node, ast.Compare):
        for place, operator in enumerate(node.ops):
            for other in _COMPARISONS[type(operator)]:
                yield _changed(node, ops=[*node.ops[:place], other(), *node.ops[place + 1 :]])


def signs(node: ast.AST) -> Iterator[ast.AST]:
    """Swap plus and minus, times and divided by, or leave out a sign."""
    if isinstance(node, ast.BinOp | ast.AugAssign) and type(node.op) in _SIGNS:
        yield _changed(node, op=_SIGNS[type(node.op)]())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield node.operand


def constants(node: ast.AST) -> Iterator[ast.AST]:
    """Change a number by one or to its double, or a truth value to the other one."""
    if not isinstance(node, ast.Constant):
        return
    value = node.value
    others: Sequence[object] = ()
    if isinstance(value, bool):
        others = (not value,)
    elif isinstance(value, int):
        others = (value + 1, value - 1) if value else (1,)
    elif isinstance(value, float) and math.isfinite(value):
        others = (2.0 * value, 0.5 * value) if value else (1.0,)
    for other in others:
        yield _changed(node, value=other)


def calls(node: ast.AST) -> Iterator[ast.AST]:
    """Leave out a call that is made for what it does, or one that rounds, sorts and the like."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
        yield ast.Pass()
    elif isinstance(node, ast.Call) and _name(node.func) in _BARE:
        match node.args:
            case [ast.Starred() | ast.GeneratorExp()]:
                return
            case [value]:
                yield value


def branches(node: ast.AST) -> Iterator[ast.AST]:
    """Never or always take a branch, leave out a part of a condition, or go on with a loop."""
    if isinstance(node, ast.If):
        for value in (False, True):
            yield _changed(node, test=ast.Constant(value))
    elif isinstance(node, ast.IfExp):
        yield from (node.body, node.orelse)
    elif isinstance(node, ast.BoolOp):
        for place in range(len(node.values)):
            yield _changed(node, values=node.values[:place] + node.values[place + 1 :])
        yield _changed(node, op=ast.Or() if isinstance(node.op, ast.And) else ast.And())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield node.operand
    elif isinstance(node, ast.comprehension):
        for place in range(len(node.ifs)):
            yield _changed(node, ifs=node.ifs[:place] + node.ifs[place + 1 :])
    elif isinstance(node, ast.Break | ast.Continue):
        yield ast.Pass()


def extremes(node: ast.AST) -> Iterator[ast.AST]:
    """Swap the smallest and the largest, up and down, any and all."""
    if not isinstance(node, ast.Name | ast.Attribute) or not isinstance(node.ctx, ast.Load):
        return
    if _name(node) in _EXTREMES:
        field = "id" if isinstance(node, ast.Name) else "attr"
        yield _changed(node, **{field: _EXTREMES[_name(node)]})


def _changed(node: ast.AST, **fields: object) -> ast.AST:
    other = copy(node)
    for name, value in fields.items():
        setattr(other, name, value)
    return other


def _name(node: ast.expr) -> str:
    """Return the last part of a name, or nothing."""
    if isinstance(node, ast.Name):
        return node.id
    return node.attr if isinstance(node, ast.Attribute) else ""


KINDS: dict[str, Callable[[ast.AST], Iterator[ast.AST]]] = {
    "comparison": comparisons,
    "sign": signs,
    "constant": constants,
    "call": calls,
    "branch": branches,
    "extreme": extremes,
}
"""The kinds of faults by name: what can take a node's place."""


@dataclass(frozen=True)
class Mutant:
    """One fault in one file; its key stays the same where its lines move."""

    file: str
    kind: str
    where: str
    before: str
    after: str
    lines: range
    path: tuple[_Step, ...]
    """The way to the node from the module."""
    replacement: ast.AST

    @property
    def key(self) -> tuple[str, str, str, str]:
        return (self.file, self.where, self.before, self.after)

    def apply(self, text: str) -> str:
        """Return the source with the fault in it, without comments."""
        tree: ast.AST = ast.parse(text)
        parent = tree
        for step in self.path[:-1]:
            parent = _below(parent, step)
        _put(parent, self.path[-1], self.replacement)
        return ast.unparse(tree)

    def is_program(self, text: str) -> bool:
        """Tell whether the source can be compiled: a fault next to a walrus may spoil it."""
        try:
            compile(self.apply(text), "mutant", "exec", dont_inherit=True)
        except (SyntaxError, ValueError):
            return False
        return True


def _below(node: ast.AST, step: _Step) -> ast.AST:
    field, place = step
    value = getattr(node, field)
    return value if place is None else value[place]  # type: ignore[no-any-return]


def _put(parent: ast.AST, step: _Step, node: ast.AST) -> None:
    field, place = step
    if place is None:
        setattr(parent, field, node)
    else:
        getattr(parent, field)[place] = node


def mutants(file: str, text: str) -> Iterator[Mutant]:
    """Find every mutant of a source, past what has no effect as it runs."""
    tree = ast.parse(text)
    yield from _mutants_below(file, tree, tree, (), ())


def _mutants_below(
    file: str, parent: ast.AST, statement: ast.AST, path: tuple[_Step, ...], where: tuple[str, ...]
) -> Iterator[Mutant]:
    for step, node in _children(parent):
        if _without_effect(node):
            continue
        around = node if isinstance(node, ast.stmt | ast.match_case) else statement
        first = node.target if isinstance(node, ast.comprehension) else node
        for kind, faults in KINDS.items():
            for fault in faults(node):
                before = _head(around)
                if node is around:
                    after = _head(fault)
                else:
                    _put(parent, step, fault)
                    after = _head(around)
                    _put(parent, step, node)
                lines = range(first.lineno, (first.end_lineno or first.lineno) + 1)  # type: ignore[attr-defined]
                yield Mutant(
                    file, kind, ".".join(where), before, after, lines, (*path, step), fault
                )
        name = getattr(node, "name", None)
        inside = (*where, name) if isinstance(name, str) and node is around else where
        yield from _mutants_below(file, node, around, (*path, step), inside)


def _children(node: ast.AST) -> Iterator[tuple[_Step, ast.AST]]:
    """Yield the nodes below one, but for types."""
    for field, value in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list", "type_params"):
            continue
        if isinstance(value, ast.AST):
            yield (field, None), value
        elif isinstance(value, list):
            nodes = [child if isinstance(child, ast.AST) else None for child in value]
            yield from (((field, place), child) for place, child in enumerate(nodes) if child)


def _without_effect(node: ast.AST) -> bool:
    """Tell whether a node is a docstring, a message's text, or for the type checker only."""
    if isinstance(node, ast.JoinedStr | ast.Import | ast.ImportFrom):
        return True
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return True
    if isinstance(node, ast.If):
        return ast.unparse(node.test) in ("TYPE_CHECKING", "typing.TYPE_CHECKING")
    return isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) in ("__all__", "__slots__")


def _head(statement: ast.AST) -> str:
    """Return a statement on its own, without those below it and without decorators."""
    alone = copy(statement)
    for field, value in (("decorator_list", []), ("body", [ast.Pass()]), ("orelse", [])):
        if isinstance(getattr(alone, field, None), list):
            setattr(alone, field, value)
    return ast.unparse(alone).partition("\n")[0]


def draw(candidates: Iterable[Mutant], number: int, seed: int) -> list[Mutant]:
    """Draw mutants at random, of each kind as many as of the others as long as there are any."""
    random = Random(seed)
    kinds: dict[str, list[Mutant]] = {name: [] for name in KINDS}
    for mutant in candidates:
        kinds[mutant.kind].append(mutant)
    for some in kinds.values():
        random.shuffle(some)
    drawn: list[Mutant] = []
    while len(drawn) < number and any(kinds.values()):
        for some in kinds.values():
            if some and len(drawn) < number:
                drawn.append(some.pop())
    return drawn
