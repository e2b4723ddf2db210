"""What became of mutants: the results of trials, the list of equivalents, and their table."""

import json
import tomllib
from collections import Counter
from pathlib import Path, PurePosixPath

from mutation.faults import Mutant
from mutation.trial import CACHE, KILLED, SURVIVED, UNREACHED, Outcome

EQUIVALENT = "equivalent"
HEAD = """\
| package | drawn | killed | equivalent | survived | not reached | killed of all but equivalents |
|---|---|---|---|---|---|---|"""


def equivalents() -> dict[tuple[str, ...], str]:
    """Return why mutants, by their keys, change nothing that the program promises."""
    text = Path(__file__).with_name("equivalent.toml").read_text(encoding="utf-8")
    return {
        (one["file"], one["where"], one["before"], one["after"]): one["reason"]
        for one in tomllib.loads(text)["equivalent"]
    }


class Ledger:
    """The results of all trials so far, kept beside the project and out of git.

    Each is one line at the end of a file, so that several runs at a time lose none.
    """

    def __init__(self, path: Path = CACHE / "results.jsonl") -> None:
        self._path = path
        self.results: dict[tuple[str, ...], str] = {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                row = json.loads(line)
                self.results[tuple(row["key"])] = row["result"]

    def note(self, mutant: Mutant, outcome: Outcome, seed: int) -> None:
        self.results[mutant.key] = outcome.result
        row = {"key": mutant.key, "kind": mutant.kind, "seed": seed, **vars(outcome)}
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")

    def table(self) -> list[str]:
        known = equivalents()
        counts: dict[str, Counter[str]] = {}
        for key, result in sorted(self.results.items()):
            parts = PurePosixPath(key[0]).parts
            package = "/".join(parts[:2]) if len(parts) > 2 else f"{parts[0]}/*.py"
            counts.setdefault(package, Counter())[EQUIVALENT if key in known else result] += 1
        rows = [_row(f"`{package}`", count) for package, count in counts.items()]
        return [HEAD, *rows, _row("all", sum(counts.values(), Counter()))]


def _row(name: str, count: Counter[str]) -> str:
    changing = count.total() - count[EQUIVALENT]
    fraction = f"{100.0 * count[KILLED] / changing:.0f} %" if changing else ""
    numbers = [count.total(), *(count[one] for one in (KILLED, EQUIVALENT, SURVIVED, UNREACHED))]
    return f"| {' | '.join([name, *map(str, numbers), fraction])} |"
