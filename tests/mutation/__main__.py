"""Mutation testing: ``python tests/mutation PACKAGE... --number N --seed S``.

N random mutants of packages, folders or files, or of the files changed since a commit
(``--changed``), are tried in a copy of the project, each against the tests that reach its line.
Survivors are printed: faults that no test has found. What tests reach is measured once and kept in
``.mutation``; a file of tests that has changed is measured anew.
"""

import argparse
import signal
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from itertools import islice
from pathlib import Path
from queue import Queue

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mutation import trial
from mutation.copy_of_project import ROOT, Copy, copy_of_project
from mutation.ledger import Equivalent, Ledger, equivalents
from mutation.mutants import Mutant, draw, is_program, mutants
from mutation.reach import Reach, files_of, measured

_ALSO = {"occ_model": ("tests/physics", "tests/hard_cases"), "occ_gui": ("tests/gui/snapshots",)}


class Run:
    """Mutants, the tests of their packages, and copies of the project to try them in."""

    def __init__(self, options: argparse.Namespace, reach: Reach, copies: Sequence[Copy]) -> None:
        self._options = options
        self._reach = reach
        self._copies: Queue[Copy] = Queue()
        for copy in copies:
            self._copies.put(copy)
        self._sources: dict[str, str] = {}
        self._sound: set[str] = set()
        self.ledger = Ledger()

    def text_of(self, file: str) -> str:
        """Return a source as it was when the copies were made."""
        if file not in self._sources:
            copy = self._copies.queue[0] if self._copies.queue else None
            root = ROOT if copy is None else copy.root
            self._sources[file] = (root / file).read_text(encoding="utf-8")
        return self._sources[file]

    def tried(self, mutant: Mutant) -> trial.Outcome:
        """Try one mutant in a copy that is free."""
        copy = self._copies.get()
        try:
            return self._tried_in(copy, mutant)
        finally:
            self._copies.put(copy)

    def _tried_in(self, copy: Copy, mutant: Mutant) -> trial.Outcome:
        """Try a mutant again without each test that would fail without it too."""
        source = self._sources[mutant.file]
        while True:
            sources = self._sources
            choice = trial.choose(mutant, self._reach.tests, sources, self._options.seconds)
            outcome = trial.tried(mutant, source, choice, copy)
            known = {test.name for test in self._reach.tests}
            if outcome.result != trial.KILLED or outcome.by not in known - self._sound:
                return outcome
            if trial.passes_unchanged(outcome.by, copy):
                self._sound.add(outcome.by)
                return outcome
            print(f"left out from now on, as it fails without a mutant: {outcome.by}")
            self._reach.tests = [one for one in self._reach.tests if one.name != outcome.by]

    def all(self, drawn: Sequence[Mutant], seed: int) -> None:
        """Try mutants, and print what becomes of each."""
        copies = list(self._copies.queue)
        with ThreadPoolExecutor(len(copies)) as pool:
            try:
                for mutant, outcome in zip(drawn, pool.map(self.tried, drawn), strict=True):
                    if outcome.result != trial.UNCLEAR:
                        self.ledger.note(mutant, outcome, seed)
                    print(described(mutant, outcome), flush=True)
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                for copy in copies:
                    copy.stop()
                raise


def described(mutant: Mutant, outcome: trial.Outcome) -> str:
    head = f"{outcome.result:9} {mutant.kind:10} {mutant.file}:{mutant.line} {mutant.where}"
    if outcome.result == trial.KILLED:
        return f"{head}  by {outcome.by}"
    more = f", {outcome.left_out} more reach it" if outcome.left_out else ""
    return "\n".join([
        head, f"    - {mutant.before}", f"    + {mutant.after}", f"    {outcome.tried} tests{more}"
    ])  # fmt: skip


def sources_of(options: argparse.Namespace) -> list[str]:
    """Return the sources that mutants are drawn from."""
    paths = [Path(path).resolve() for path in options.paths]
    found = [
        file.relative_to(ROOT).as_posix()
        for path in paths
        for file in ([path] if path.is_file() else sorted(path.rglob("*.py")))
    ]
    if options.changed is None:
        return found
    changed = subprocess.run(
        ["git", "diff", "--name-only", "--diff-filter=d", options.changed],
        cwd=ROOT, capture_output=True, check=True, text=True,
    ).stdout.splitlines()  # fmt: skip
    own = [name for name in changed if name.startswith(tuple(_ALSO)) and name.endswith(".py")]
    return [name for name in own if not found or name in found]


def folders_of(sources: Sequence[str]) -> list[Path]:
    """Return the folders of tests that belong to sources."""
    folders: dict[Path, None] = {}
    for source in sources:
        package, *rest = Path(source).parts
        own = ROOT / trial.folder_of_tests(
            "/".join([package, *rest[:1], "x"] if rest[1:] else [source])
        )
        folders[own if own.is_dir() else own.parent] = None
        folders |= dict.fromkeys(ROOT / name for name in _ALSO[package])
    return list(folders)


def drawn_mutants(
    options: argparse.Namespace, run: Run, sources: Sequence[str], known: Sequence[Equivalent]
) -> list[Mutant]:
    """Draw mutants, or find those again that have survived before."""
    every = [mutant for file in sources for mutant in mutants(file, run.text_of(file))]
    if options.again:
        results = run.ledger.results()
        drawn = [one for one in every if results.get(one.key) in (trial.SURVIVED, trial.UNREACHED)]
    else:
        drawn = draw(every, 2 * options.number, options.seed)
    programs = (one for one in drawn if is_program(one.apply(run.text_of(one.file))))
    drawn = list(programs if options.again else islice(programs, options.number))
    equal = [one for one in drawn if any(entry.is_of(one) for entry in known)]
    for mutant in equal:
        run.ledger.note(mutant, trial.Outcome("equivalent", "", 0, 0), options.seed)
    return [one for one in drawn if one not in equal]


def read_command_line(words: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python tests/mutation", description=__doc__)
    add = parser.add_argument
    add("paths", nargs="*", help="packages, folders or files, as occ_model/effects")
    add("--changed", metavar="COMMIT", help="of the files changed since a commit")
    add("--number", type=int, default=30, help="mutants to draw, default: %(default)s")
    add("--seed", type=int, default=1, help="default: %(default)s")
    add("--tests", nargs="+", type=Path, help="tests to measure instead of the packages' own")
    add("--also", nargs="+", type=Path, default=[], help="tests to measure besides")
    add("--seconds", type=float, default=60.0, help="of tests a mutant, default: %(default)s")
    add("--file-seconds", type=float, default=60.0,
        help="of tests a file that are measured, default: %(default)s")  # fmt: skip
    add("--jobs", type=int, default=1, help="mutants at a time, default: %(default)s")
    add("--again", action="store_true", help="try those that have survived before")
    add("--measure", action="store_true", help="only measure what the tests reach")
    add("--table", action="store_true", help="only print the table of all results so far")
    options = parser.parse_args(words)
    if not (options.paths or options.changed or options.table):
        parser.error("name packages, folders or files, or --changed COMMIT")
    for path in options.paths:
        if not Path(path).exists():
            parser.error(f"there is no {path}")
    return options


def main(words: Sequence[str] | None = None) -> None:
    options = read_command_line(words)
    # However it is ended, the copies go, and what runs in them.
    signal.signal(signal.SIGTERM, lambda number, _frame: sys.exit(128 + number))
    known = equivalents()
    if options.table:
        print("\n".join(Ledger().table(known)))
        return
    sources = sources_of(options)
    with ExitStack() as stack:
        copies = [stack.enter_context(copy_of_project()) for _ in range(options.jobs)]
        folders = options.tests or folders_of(sources)
        reach = measured(files_of([*folders, *options.also]), copies[0], options.file_seconds)
        left_out = f"{len(reach.left_out)} left out, as others of their files took long"
        print(f"{len(reach.tests)} tests, and {left_out}")
        if options.measure:
            return
        run = Run(options, reach, copies)
        drawn = drawn_mutants(options, run, sources, known)
        run.all(drawn, options.seed)
        print("\n".join(run.ledger.table(known)))


if __name__ == "__main__":
    main()
