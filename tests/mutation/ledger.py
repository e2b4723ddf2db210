"""What became of mutants: the results of trials, the list of equivalents, and their table."""

import hashlib
import json
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from mutation.mutants import Mutant
from mutation.reach import CACHE
from mutation.trial import KILLED, SURVIVED, UNREACHED, Outcome

EQUIVALENT = "equivalent"
LIST = Path(__file__).with_name("equivalent.toml")
RESULTS = CACHE / "results"

HEAD = """\
| package | drawn | killed | equivalent | survived | not reached | killed of all but equivalents |
|---|---|---|---|---|---|---|"""


@dataclass(frozen=True)
class Equivalent:
    """Mutants that change nothing that the program promises, known by their texts."""

    file: str
    where: str
    before: str
    after: str
    reason: str

    def is_of(self, mutant: Mutant) -> bool:
        """Tell whether this is the entry of a mutant."""
        return (self.file, self.where, self.before, self.after) == mutant.key[:4]


def equivalents(path: Path = LIST) -> list[Equivalent]:
    entries = tomllib.loads(path.read_text(encoding="utf-8"))["equivalent"]
    return [Equivalent(**entry) for entry in entries]


def package_of(file: str) -> str:
    """Return the package that a file is counted to."""
    parts = PurePosixPath(file).parts
    return "/".join(parts[:2]) if len(parts) > 2 else f"{parts[0]}/*.py"


class Ledger:
    """The results of all trials so far, kept beside the project and out of git.

    Each has a file of its own, so that several runs at a time lose none.
    """

    def __init__(self, folder: Path = RESULTS) -> None:
        self.folder = folder
        self._rows: dict[tuple[Any, ...], dict[str, Any]] = {}
        for path in folder.glob("*.json"):
            row = json.loads(path.read_text(encoding="utf-8"))
            self._rows[tuple(row["key"])] = row

    def note(self, mutant: Mutant, outcome: Outcome, seed: int) -> None:
        before = self._rows.get(mutant.key, {})
        self._rows[mutant.key] = row = {
            "key": mutant.key,
            "kind": mutant.kind,
            "line": mutant.line,
            "seed": before.get("seed", seed),
            "first": before.get("first", outcome.result),
            "result": outcome.result,
            "by": outcome.by,
            "tried": outcome.tried,
            "left out": outcome.left_out,
        }
        self.folder.mkdir(parents=True, exist_ok=True)
        name = hashlib.sha256(repr(mutant.key).encode()).hexdigest()[:16]
        (self.folder / f"{name}.json").write_text(json.dumps(row, indent=1), encoding="utf-8")

    def results(self) -> Mapping[tuple[Any, ...], str]:
        return {key: str(row["result"]) for key, row in self._rows.items()}

    def table(self, known: Iterable[Equivalent]) -> list[str]:
        listed = {(one.file, one.where, one.before, one.after) for one in known}
        counts: dict[str, Counter[str]] = {}
        for key, row in sorted(self._rows.items()):
            result = EQUIVALENT if key[:4] in listed else row["result"]
            counts.setdefault(package_of(key[0]), Counter())[result] += 1
        lines = [HEAD]
        for package, count in counts.items():
            lines.append(_row(f"`{package}`", count))
        return [*lines, _row("all", sum(counts.values(), Counter()))]


def _row(name: str, count: Counter[str]) -> str:
    drawn, killed, equal = count.total(), count[KILLED], count[EQUIVALENT]
    survived, unreached = count[SURVIVED], count[UNREACHED]
    changing = drawn - equal
    fraction = f"{100.0 * killed / changing:.0f} %" if changing else ""
    return f"| {name} | {drawn} | {killed} | {equal} | {survived} | {unreached} | {fraction} |"
