"""Mutants: a source with one fault in it, and how they are found and drawn."""

import ast
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from random import Random

from mutation.edits import KINDS, Edit, Source

_Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Mutant:
    """One fault in one file.

    Its key is made of texts and names only, so that it stays the same where its lines move.
    """

    file: str
    kind: str
    where: str
    line: int
    last_line: int
    before: str
    after: str
    edit: Edit
    at_import: bool
    """Whether the line is run as the file is imported, and not as a function is called."""
    names: frozenset[str] = frozenset()
    """What the line gives its value to, where it is run as the file is imported."""
    same: int = 0
    """How many mutants with the same texts are before this one in the function."""

    @property
    def key(self) -> tuple[str, str, str, str, int]:
        return (self.file, self.where, self.before, self.after, self.same)

    def apply(self, text: str) -> str:
        data = text.encode()
        return (data[: self.edit.start] + self.edit.text + data[self.edit.end :]).decode()


class _Finder:
    """Walks through a source, past what has no effect as it runs."""

    def __init__(self, file: str, text: str) -> None:
        self.file = file
        self.text = text
        self.source = Source(text)
        self.found: list[Mutant] = []
        self._where: list[str] = []
        self._depth = 0  # functions around the node
        self._cached = 0
        self._statement: ast.stmt | None = None

    def walk(self, node: ast.AST) -> None:
        """Take in a node and all below it."""
        if _without_effect(node):
            return
        statement = self._statement
        if isinstance(node, ast.stmt):
            self._statement = node
        for kind, edits in KINDS.items():
            for edit in edits(node, self.source):
                self._add(kind, edit)
        if isinstance(node, _Function):
            # Defaults are set as the function is defined.
            self._below([*node.args.defaults, *filter(None, node.args.kw_defaults)], node.name)
            self._depth += 1
            self._cached += _is_cached(node)
            self._below(node.body, node.name)
            self._cached -= _is_cached(node)
            self._depth -= 1
        elif isinstance(node, ast.ClassDef):
            self._below([*node.keywords, *node.body], node.name)
        else:
            for child in _children(node):
                self.walk(child)
        self._statement = statement

    def _below(self, nodes: Iterable[ast.AST], name: str) -> None:
        self._where.append(name)
        for child in nodes:
            self.walk(child)
        self._where.pop()

    def _add(self, kind: str, edit: Edit) -> None:
        data = self.source.bytes
        changed = data[: edit.start] + edit.text + data[edit.end :]
        line = data.count(b"\n", 0, edit.start) + 1
        last = line + data.count(b"\n", edit.start, edit.end)
        assert self._statement is not None
        at_import = not self._depth or self._cached > 0
        self.found.append(
            Mutant(
                self.file, kind, ".".join(self._where), line, last,
                _lines(data, line, last), _lines(changed, line, last), edit,
                at_import, self._names() if at_import else frozenset(),
            )
        )  # fmt: skip

    def _names(self) -> frozenset[str]:
        """Return the names under which others use a value that is made once."""
        statement = self._statement
        assert statement is not None
        given = {
            node.id
            for node in ast.walk(statement)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }
        return frozenset(given | set(self._where[-1:]))


def _without_effect(node: ast.AST) -> bool:
    """Tell whether a node is a type, a docstring, or for the type checker only.

    Texts with values in them are left out too: before Python 3.12 nothing tells where their parts
    are.
    """
    if isinstance(node, ast.JoinedStr | ast.Import | ast.ImportFrom):
        return True
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return True
    if isinstance(node, ast.If):
        return ast.unparse(node.test) in ("TYPE_CHECKING", "typing.TYPE_CHECKING")
    return isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) in ("__all__", "__slots__")


def _children(node: ast.AST) -> Iterator[ast.AST]:
    """Give the nodes below one, but for types."""
    for name, value in ast.iter_fields(node):
        if name not in ("annotation", "returns", "decorator_list"):
            yield from (
                child
                for child in (value if isinstance(value, list) else [value])
                if isinstance(child, ast.AST)
            )


def _is_cached(node: ast.AST) -> bool:
    """Tell whether a function keeps its results, so that only the first test runs it."""
    return isinstance(node, _Function) and any(
        "cache" in ast.unparse(decorator) for decorator in node.decorator_list
    )


def _lines(data: bytes, first: int, last: int) -> str:
    """Return lines without their indentation and comments, as one."""
    lines = [line.partition("  #")[0] for line in data.decode().splitlines()[first - 1 : last]]
    return " ".join(" ".join(lines).split())


def mutants(file: str, text: str) -> list[Mutant]:
    """Return every mutant of a source; :func:`is_program` tells which can be tried."""
    finder = _Finder(file, text)
    finder.walk(finder.source.tree)
    seen: Counter[tuple[str, str, str]] = Counter()
    result = []
    for mutant in finder.found:
        texts = (mutant.where, mutant.before, mutant.after)
        result.append(replace(mutant, same=seen[texts]))
        seen[texts] += 1
    return result


def is_program(text: str) -> bool:
    """Tell whether a source can be compiled: an edit next to a walrus may spoil it."""
    try:
        compile(text, "mutant", "exec", dont_inherit=True)
    except (SyntaxError, ValueError):
        return False
    return True


def draw(candidates: Iterable[Mutant], number: int, seed: int) -> list[Mutant]:
    """Draw mutants at random, of each kind as many as of the others as long as there are any."""
    random = Random(seed)
    kinds: dict[str, list[Mutant]] = {name: [] for name in KINDS}
    for mutant in sorted(candidates, key=lambda one: (one.file, one.edit.start, one.edit.text)):
        kinds[mutant.kind].append(mutant)
    for found in kinds.values():
        random.shuffle(found)
    drawn: list[Mutant] = []
    while len(drawn) < number and any(kinds.values()):
        names = [name for name, found in kinds.items() if found]
        random.shuffle(names)
        drawn += [kinds[name].pop() for name in names[: number - len(drawn)]]
    return drawn
