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
from itertools import islice
from pathlib import Path, PurePosixPath

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mutation import trial
from mutation.copied import ROOT, Copy, copy_of_project
from mutation.faults import Mutant, draw, mutants
from mutation.ledger import EQUIVALENT, Ledger, equivalents

_TESTS = {
    "occ_model": ("tests/model", ["tests/physics", "tests/hard_cases"]),
    "occ_gui": ("tests/gui", ["tests/gui/snapshots"]),
}


def described(mutant: Mutant, outcome: trial.Outcome, choice: trial.Choice) -> str:
    place = f"{mutant.file}:{mutant.lines.start} {mutant.where}"
    head = f"{outcome.result:9} {mutant.kind:10} {place}"
    if outcome.result == trial.KILLED:
        return f"{head}  by {outcome.by}"
    tests = f"    {len(choice.files)} files of tests, {choice.left_out} more reach it"
    return "\n".join([head, f"    - {mutant.before}", f"    + {mutant.after}", tests])


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
    own = [name for name in changed if name.startswith(tuple(_TESTS)) and name.endswith(".py")]
    return [name for name in own if not found or name in found]


def files_of_tests(options: argparse.Namespace, sources: Sequence[str]) -> list[str]:
    """Return the files of tests to measure: those named, or those that belong to the sources."""
    paths: list[Path] = list(options.tests or [])
    for source in [] if options.tests else sources:
        package, *rest = PurePosixPath(source).parts
        mirror, also = _TESTS[package]
        own = ROOT.joinpath(mirror, *rest[:-1][:1])
        paths += [own if own.is_dir() else own.parent, *(ROOT / name for name in also)]
    paths += options.also
    found = {
        file.resolve().relative_to(ROOT).as_posix()
        for path in dict.fromkeys(paths)
        for file in ([path] if path.is_file() else path.rglob("test_*.py"))
    }
    return sorted(found)


def drawn_mutants(
    options: argparse.Namespace, ledger: Ledger, sources: Sequence[str], copy: Copy
) -> list[Mutant]:
    """Draw mutants, or find those again that have survived before."""
    texts = {file: (copy.root / file).read_text(encoding="utf-8") for file in sources}
    every = [mutant for file, text in texts.items() for mutant in mutants(file, text)]
    if options.again:
        lasting = (trial.SURVIVED, trial.UNREACHED)
        return [one for one in every if ledger.results.get(one.key) in lasting]
    drawn = draw(every, 2 * options.number, options.seed)
    programs = (one for one in drawn if one.is_program(texts[one.file]))
    return list(islice(programs, options.number))


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
    # However it is ended, the copy goes, and what runs in it.
    signal.signal(signal.SIGTERM, lambda number, _frame: sys.exit(128 + number))
    ledger = Ledger()
    if not options.table:
        sources = sources_of(options)
        with copy_of_project() as copy:
            tests = [trial.measured(name, copy) for name in files_of_tests(options, sources)]
            if options.measure:
                return
            for mutant in drawn_mutants(options, ledger, sources, copy):
                if mutant.key in equivalents():
                    ledger.note(mutant, trial.Outcome(EQUIVALENT), options.seed)
                    continue
                choice = trial.choose(mutant, tests, options.seconds, copy)
                outcome = trial.tried(mutant, choice, copy)
                if outcome.result != trial.UNCLEAR:
                    ledger.note(mutant, outcome, options.seed)
                print(described(mutant, outcome, choice), flush=True)
    print("\n".join(ledger.table()))


if __name__ == "__main__":
    main()
