"""Trying a mutant: files of tests that reach it are chosen and run in the copy; one should fail.

What each file of tests reaches is measured once, in a process of its own, so that it also reaches
what is run at import or kept by a cache.
"""

import json
import os
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from hashlib import sha256
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory

from mutation.copied import ROOT, Copy
from mutation.faults import Mutant

CACHE = ROOT / ".mutation"
KILLED, SURVIVED, UNREACHED, UNCLEAR = "killed", "survived", "unreached", "unclear"

_MIRRORS = {"occ_model": "tests/model", "occ_gui": "tests/gui"}
_PATIENCE = 60.0
_SLOWER = 5.0
_PYTEST = ["pytest", "-q", "--tb=line", "-p", "no:cacheprovider"]
_PASSED, _NO_TESTS = 0, 5
_FAILED = re.compile(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", re.MULTILINE)
_COVERAGE = """\
[run]
source = occ_model, occ_gui
parallel = true
patch = subprocess
concurrency = multiprocessing, thread
disable_warnings = no-data-collected, module-not-imported, module-not-measured
"""


@dataclass(frozen=True)
class MeasuredFile:
    """A file of tests as it was measured."""

    name: str
    hash: str
    seconds: float
    """Of the processor: others that run beside it take none of it."""
    failing: list[str]
    """Tests that fail without any mutant, which are left out."""
    lines: dict[str, list[int]]
    """The lines that it runs of each source."""
    sources: dict[str, str]
    """The sources as they were measured, by their hashes."""


def measured(name: str, copy: Copy) -> MeasuredFile:
    """Return what a file of tests reaches, and measure it where it is new or has changed."""
    kept = CACHE / "reach" / f"{name}.json"
    if kept.exists():
        found = MeasuredFile(**json.loads(kept.read_text(encoding="utf-8")))
        if found.hash == _hash(copy.root / name):
            return found
    print(f"Measuring what {name} reaches ...", flush=True)
    found = _measure(name, copy)
    kept.parent.mkdir(parents=True, exist_ok=True)
    kept.write_text(json.dumps(asdict(found)), encoding="utf-8")
    return found


def _measure(name: str, copy: Copy) -> MeasuredFile:
    import coverage

    with TemporaryDirectory(prefix="reach-") as folder:
        settings = Path(folder, "coverage.ini")
        settings.write_text(f"{_COVERAGE}data_file = {folder}/lines\n", encoding="utf-8")
        begun = sum(os.times()[2:4])
        _, printed = copy.run(
            ["-m", "coverage", "run", f"--rcfile={settings}", "-m", *_PYTEST, name]
        )
        seconds = sum(os.times()[2:4]) - begun
        measurement = coverage.Coverage(config_file=str(settings))
        measurement.combine()
        data = measurement.get_data()
        lines = {
            Path(file).relative_to(copy.root).as_posix(): sorted(data.lines(file) or ())
            for file in data.measured_files()
            if Path(file).is_relative_to(copy.root)
        }
    sources = {source: _hash(copy.root / source) for source in lines}
    hash_of_file = _hash(copy.root / name)
    return MeasuredFile(name, hash_of_file, seconds, _FAILED.findall(printed), lines, sources)


def _hash(path: Path) -> str:
    return sha256(path.read_bytes()).hexdigest()[:16]


def nearness(tests: str, file: str) -> int:
    """Order files of tests by their names and folders: 0 is nearest."""
    test, source = PurePosixPath(tests), PurePosixPath(file)
    package, *folders = source.parent.parts
    mirror = (_MIRRORS.get(package, "tests"), *folders)
    if test.stem == f"test_{source.stem}":
        return 0
    if test.parent == PurePosixPath(*mirror):
        return 1
    return 2 if test.is_relative_to(PurePosixPath(*mirror[:2])) else 3


@dataclass(frozen=True)
class Choice:
    """The files of tests of a mutant, the most promising first."""

    files: list[MeasuredFile]
    left_out: int
    """How many more reach the line, for which there is no time."""


def choose(mutant: Mutant, files: Iterable[MeasuredFile], seconds: float, copy: Copy) -> Choice:
    """Choose the files of tests that reach a mutant, up to some time.

    Near ones come first, then those that run most of its file. Where none is seen to run the line,
    which also may be one of a source that has changed, all are taken that run any line of the file.
    """
    users = sorted(
        (one for one in files if one.lines.get(mutant.file)),
        key=lambda one: (nearness(one.name, mutant.file), -len(one.lines[mutant.file])),
    )
    source = _hash(copy.root / mutant.file)
    reaching = [
        one
        for one in users
        if one.sources[mutant.file] != source
        or not set(mutant.lines).isdisjoint(one.lines[mutant.file])
    ]
    chosen: list[MeasuredFile] = []
    for one in reaching or users:
        if not chosen or sum(other.seconds for other in chosen) + one.seconds <= seconds:
            chosen.append(one)
    return Choice(chosen, len(reaching or users) - len(chosen))


@dataclass(frozen=True)
class Outcome:
    result: str
    by: str = ""
    """The first test that failed, or why the mutant counts as killed."""


def tried(mutant: Mutant, choice: Choice, copy: Copy) -> Outcome:
    """Put a mutant into the copy, run its tests, and take it out again."""
    if not choice.files:
        return Outcome(UNREACHED)
    failing = [name for one in choice.files for name in one.failing]
    left_out = [f"--deselect={name}" for name in failing]
    tests = ["-m", *_PYTEST, "-x", *left_out, *(one.name for one in choice.files)]
    seconds = _PATIENCE + _SLOWER * sum(one.seconds for one in choice.files)
    source = (copy.root / mutant.file).read_text(encoding="utf-8")
    copy.write(mutant.file, mutant.apply(source))
    try:
        code, printed = copy.run(tests, seconds)
    finally:
        copy.write(mutant.file, source)
    if code is None:
        # On a machine that is busy the tests may take as long without a mutant.
        code, _ = copy.run(tests, seconds)
        return Outcome(UNCLEAR if code is None else KILLED, "time")
    if code in (_PASSED, _NO_TESTS):
        return Outcome(SURVIVED)
    return Outcome(KILLED, next(iter(_FAILED.findall(printed)), f"exit {code}"))
