"""Which tests reach a line, and what they cost: measured once, and kept beside the project."""

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from difflib import SequenceMatcher
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mutation import recorder
from mutation.copy_of_project import ROOT, Copy

CACHE = ROOT / ".mutation"
_LONGEST = 3600.0


@dataclass(frozen=True)
class MeasuredTest:
    name: str
    seconds: float
    lines: Mapping[str, int]
    """For each source file a number whose bits are the lines, also those of shared fixtures."""

    @property
    def file(self) -> str:
        return self.name.partition("::")[0]

    def runs(self, file: str, lines: Iterable[int]) -> bool:
        """Tell whether it runs one of a file's lines."""
        bits = self.lines.get(file, 0)
        return any(bits >> line & 1 for line in lines)


@dataclass
class Reach:
    """What is known of the tests of some folders."""

    tests: list[MeasuredTest] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    """Tests that were not measured, since others of their file took long."""
    sources: dict[str, str] = field(default_factory=dict)
    """The sources as they were measured, by their hashes."""


def files_of(tests: Iterable[Path]) -> list[str]:
    """Return the files of tests in folders, or of tests that are named, as git writes them."""
    found = {
        file for path in tests for file in ([path] if path.is_file() else path.rglob("test_*.py"))
    }
    return sorted(file.resolve().relative_to(ROOT).as_posix() for file in found)


def measured(files: Iterable[str], copy: Copy, file_seconds: float) -> Reach:
    """Return what files of tests reach, and measure those that are new or have changed.

    Each folder's tests run in a process of their own.
    """
    reach = Reach()
    files = list(files)
    missing: dict[str, list[str]] = {}
    for file in files:
        if not _is_kept(file):
            missing.setdefault(str(Path(file).parent), []).append(file)
    for folder, some in missing.items():
        print(f"Measuring what {len(some)} files in {folder} reach ...", flush=True)
        _measure(some, copy, file_seconds)
    for file in files:
        _take(file, reach)
    return reach


def _kept_at(file: str) -> Path:
    return CACHE / "reach" / f"{file}.json"


def _hash(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def _is_kept(file: str) -> bool:
    """Tell whether a file of tests is known as it is now."""
    path = _kept_at(file)
    if not path.exists():
        return False
    found = json.loads(path.read_text(encoding="utf-8"))
    return bool(found["hash"] == _hash(ROOT / file))


def _measure(files: list[str], copy: Copy, file_seconds: float) -> None:
    """Run files of tests once, and keep what each test reaches."""
    with TemporaryDirectory(prefix="reach-") as name:
        folder = Path(name)
        settings = {
            recorder.FOLDER: name,
            recorder.PACKAGES: "occ_model,occ_gui",
            recorder.FILE_SECONDS: str(file_seconds),
        }
        arguments = ["-m", "pytest", "-q", "-p", "mutation.recorder", "-p", "no:cacheprovider"]
        _, printed = copy.run([*arguments, *files], _LONGEST, settings)
        try:
            found = json.loads((folder / "tests.json").read_text(encoding="utf-8"))
        except FileNotFoundError as error:
            raise RuntimeError(f"the tests could not be measured:\n{printed}") from error
        lines = _lines_of(folder, copy.root)
    sources = {name for of_test in lines.values() for name in of_test}
    hashes = {name: _hash(copy.root / name) for name in sources}
    for source, name in hashes.items():
        kept = CACHE / "sources" / name
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_bytes((copy.root / source).read_bytes())
    for file in files:
        _keep(file, copy, found, lines, hashes)


def _keep(
    file: str,
    copy: Copy,
    found: Mapping[str, Any],
    lines: Mapping[str, Mapping[str, int]],
    hashes: Mapping[str, str],
) -> None:
    """Store what the tests of one file reach."""
    tests = {name: test for name, test in found["tests"].items() if name.startswith(f"{file}::")}
    for name, test in tests.items():
        reached: dict[str, int] = {}
        for context in (name, recorder.PROCESS + name, *test.pop("fixtures")):
            for source, bits in lines.get(context, {}).items():
                reached[source] = reached.get(source, 0) | bits
        test["lines"] = {source: format(bits, "x") for source, bits in reached.items()}
    kept = _kept_at(file)
    kept.parent.mkdir(parents=True, exist_ok=True)
    left_out = [name for name in found["left out"] if name.startswith(f"{file}::")]
    content = {
        "hash": _hash(copy.root / file), "tests": tests, "left out": left_out, "sources": hashes
    }  # fmt: skip
    kept.write_text(json.dumps(content), encoding="utf-8")


def _lines_of(folder: Path, root: Path) -> dict[str, dict[str, int]]:
    """Read which lines were run under which name."""
    from coverage import CoverageData
    from coverage.exceptions import CoverageException

    result: dict[str, dict[str, int]] = {}
    for path in folder.glob("lines.*"):
        data = CoverageData(str(path))
        try:
            data.read()
        except CoverageException:  # of a process that was ended as it wrote
            continue
        for file in data.measured_files():
            if not Path(file).is_relative_to(root):
                continue
            name = Path(file).relative_to(root).as_posix()
            for line, contexts in data.contexts_by_lineno(file).items():
                for context in filter(None, contexts):
                    of_context = result.setdefault(context, {})
                    of_context[name] = of_context.get(name, 0) | 1 << line
    return result


def _take(file: str, reach: Reach) -> None:
    """Add what is kept of a file of tests."""
    found = json.loads(_kept_at(file).read_text(encoding="utf-8"))
    reach.left_out += found["left out"]
    moves = {
        source: _moves(CACHE / "sources" / name, ROOT / source)
        for source, name in found["sources"].items()
        if not (ROOT / source).exists() or _hash(ROOT / source) != name
    }
    for name, test in found["tests"].items():
        lines = {source: int(bits, 16) for source, bits in test["lines"].items()}
        for source, moved in moves.items():
            if source in lines:
                lines[source] = _moved(lines[source], moved)
        reach.tests.append(MeasuredTest(name, test["seconds"], lines))


def _moves(before: Path, after: Path) -> dict[int, int]:
    if not after.exists():
        return {}
    return moved_lines(*(path.read_text(encoding="utf-8") for path in (before, after)))


def moved_lines(before: str, after: str) -> dict[int, int]:
    """Return for each line of a source that was changed, where it has been before."""
    old, new = before.splitlines(), after.splitlines()
    moved: dict[int, int] = {}
    for _, first, last, there, end in SequenceMatcher(None, old, new, False).get_opcodes():
        for line in range(there, end):
            # A line that was changed is reached where the one in its place was.
            moved[line + 1] = min(first + line - there, max(last - 1, first)) + 1
    return moved


def _moved(bits: int, moves: Mapping[int, int]) -> int:
    return sum(1 << line for line, old in moves.items() if bits >> old & 1)


def lines_naming(text: str, names: Iterable[str]) -> list[int]:
    """Return the lines of a source that have one of some names in them."""
    words = "|".join(map(re.escape, names))
    if not words:
        return []
    pattern = re.compile(rf"\b(?:{words})\b")
    return [number for number, line in enumerate(text.splitlines(), 1) if pattern.search(line)]
