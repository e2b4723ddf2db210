"""A small project with a weak and a strong test: one mutant survives, another one dies."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from mutation.copy_of_project import ROOT, Copy
from mutation.ledger import Equivalent, Ledger, equivalents, package_of
from mutation.mutants import Mutant, mutants
from mutation.reach import MeasuredTest, lines_naming, moved_lines
from mutation.trial import (
    KILLED,
    SURVIVED,
    UNCLEAR,
    UNREACHED,
    Choice,
    Outcome,
    choose,
    folder_of_tests,
    nearness,
    tried,
)

SOURCE = """\
LIMIT = 3


def is_small(number):
    while number > 100:
        number -= 1
    return number < LIMIT
"""

TESTS = """\
from sizes import is_small


def test_a_one_is_small():
    assert is_small(1)


def test_a_thousand_is_not():
    assert not is_small(1000)
"""
NAMES = ("test_sizes.py::test_a_one_is_small", "test_sizes.py::test_a_thousand_is_not")


@pytest.fixture
def copy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Copy]:
    # The small project's tests need no plug-ins, which take long to start.
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    project = tmp_path / "project"
    project.mkdir()
    (project / "sizes.py").write_text(SOURCE)
    (project / "test_sizes.py").write_text(TESTS)
    copy = Copy(project)
    yield copy
    copy.stop()


def mutant(after: str) -> Mutant:
    return next(one for one in mutants("sizes.py", SOURCE) if one.after == after)


def chosen(*names: str) -> Choice:
    tests = tuple(MeasuredTest(name, 0.01, {"sizes.py": 0b11110000}) for name in names)
    return Choice(tests, 0, is_reached=True)


def test_a_fault_that_a_test_sees_is_killed_and_another_survives(copy: Copy) -> None:
    everything = chosen(*NAMES)
    killed = tried(mutant("return number >= LIMIT"), SOURCE, everything, copy)
    assert (killed.result, killed.by, killed.tried) == (KILLED, NAMES[0], 2)
    survived = tried(mutant("return number <= LIMIT"), SOURCE, everything, copy)
    assert (survived.result, survived.tried) == (SURVIVED, 2)
    # A mutant of as many letters is not taken for the compiled one before it.
    again = tried(mutant("return number >= LIMIT"), SOURCE, everything, copy)
    assert again.result == KILLED
    assert (copy.root / "sizes.py").read_text() == SOURCE


@pytest.mark.whole
def test_a_loop_without_end_is_killed_unless_all_takes_as_long_without_it(
    copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mutation.trial._PATIENCE", 3.0)
    outcome = tried(mutant("number += 1"), SOURCE, chosen(NAMES[1]), copy)
    assert (outcome.result, outcome.by) == (KILLED, "time")
    (copy.root / "test_slow.py").write_text("import time\n\ndef test_it():\n    time.sleep(60.0)\n")
    outcome = tried(mutant("number += 1"), SOURCE, chosen("test_slow.py::test_it"), copy)
    assert (outcome.result, outcome.by) == (UNCLEAR, "time")
    assert (copy.root / "sizes.py").read_text() == SOURCE


def test_a_name_of_a_test_that_the_mutant_changes_is_looked_for_in_its_file(copy: Copy) -> None:
    (copy.root / "test_sizes.py").write_text(
        "import pytest, sizes\n"
        "@pytest.mark.parametrize('limit', [sizes.LIMIT])\n"
        "def test_it(limit):\n    assert limit == 3\n"
    )
    outcome = tried(mutant("LIMIT = 4"), SOURCE, chosen("test_sizes.py::test_it[3]"), copy)
    assert (outcome.result, outcome.by) == (KILLED, "test_sizes.py::test_it[4]")


def test_a_mutant_without_tests_is_said_to_be_unreached(copy: Copy) -> None:
    assert tried(mutant("LIMIT = 4"), SOURCE, chosen(), copy).result == UNREACHED


FILE = "occ_model/effects/noise.py"


def test_tests_are_chosen_by_the_line_and_ordered_by_nearness_and_cost() -> None:
    def of(name: str, seconds: float, line: int) -> MeasuredTest:
        return MeasuredTest(f"{name}::test", seconds, {FILE: 1 << line})

    far = of("tests/physics/test_light.py", 0.1, 2)
    slow = of("tests/model/effects/test_plan.py", 3.0, 2)
    fast = of("tests/model/effects/test_size.py", 0.2, 2)
    own = of("tests/model/effects/test_noise.py", 9.0, 2)
    other = of("tests/physics/test_other.py", 0.1, 1)
    source = "LIMIT = 1\nf(b < 1)\n"
    (fault, *_) = (one for one in mutants(FILE, f"def g():\n    {source}") if one.line == 2)
    tests = [far, slow, fast, own, other]
    choice = choose(fault, tests, {}, seconds=60.0)
    assert choice.tests == (own, fast, slow, far)
    assert choice.is_reached
    short = choose(fault, tests, {}, seconds=9.25)
    assert short.tests == (own, fast)
    assert short.left_out == 2
    constant = next(one for one in mutants(FILE, source) if one.line == 1)
    users = choose(constant, [of("tests/physics/a.py", 1.0, 2)], {FILE: "\nLIMIT"}, 60.0)
    assert users.is_reached


def test_folders_of_tests_mirror_those_of_the_sources() -> None:
    assert folder_of_tests(FILE) == "tests/model/effects"
    assert folder_of_tests("occ_gui/window/a/b.py") == "tests/gui/window/a"
    assert nearness(MeasuredTest("tests/model/effects/test_noise.py::a", 0.0, {}), FILE) == 0
    assert nearness(MeasuredTest("tests/physics/test_light.py::a", 0.0, {}), FILE) == 3
    assert package_of(FILE) == "occ_model/effects"
    assert package_of("occ_model/cli.py") == "occ_model/*.py"


def test_a_line_is_found_again_where_the_source_has_changed() -> None:
    before = "a\nb\nc\nd\n"
    assert moved_lines(before, "new\na\nb\nchanged\nd\n") == {1: 1, 2: 1, 3: 2, 4: 3, 5: 4}
    assert lines_naming("one two\ntwofold\n", ["two"]) == [1]


def test_results_and_equivalents_make_the_table(tmp_path: Path) -> None:
    ledger = Ledger(tmp_path / "results")
    every = mutants("occ_model/sizes/sizes.py", SOURCE)
    for result, one in zip([SURVIVED, KILLED, KILLED, UNREACHED], every, strict=False):
        ledger.note(one, Outcome(result, "", 1, 0), seed=1)
    equal = Equivalent(*every[0].key[:4], reason="it is one")
    read = Ledger(tmp_path / "results")
    assert read.table([equal])[-1] == "| all | 4 | 2 | 1 | 0 | 1 | 67 % |"
    assert read.table([])[-1] == "| all | 4 | 2 | 0 | 1 | 1 | 50 % |"


def test_every_equivalent_is_still_a_mutant_of_its_file() -> None:
    for entry in equivalents():
        text = (ROOT / entry.file).read_text(encoding="utf-8")
        assert any(map(entry.is_of, mutants(entry.file, text))), entry
        assert len(entry.reason) > 10


def test_what_a_copy_runs_imports_the_copy(copy: Copy) -> None:
    program = "import subprocess, sys; import sizes; print(sizes.__file__, flush=True); " + (
        "subprocess.run([sys.executable, '-c', 'import sizes; print(sizes.__file__)'])"
    )
    code, printed = copy.run(["-c", program], timeout=60.0)
    assert code == 0
    assert {Path(line) for line in printed.split(os.linesep) if line} == {copy.root / "sizes.py"}


def test_each_run_of_tests_imports_the_project_anew_and_others_packages_once(copy: Copy) -> None:
    (copy.root / "test_sizes.py").write_text(
        "import os, sys\n"
        "def test_it():\n    import sizes\n"
        "    print(os.getppid(), 'PIL.Image' in sys.modules, sizes.LIMIT, sizes.__file__)\n"
        "    import PIL.Image\n"
    )
    run = ["-q", "-s", "-p", "no:cacheprovider", "-W", "ignore::pytest.PytestAssertRewriteWarning"]
    code, first = copy.pytest([*run, "test_sizes.py"], timeout=60.0)
    copy.write("sizes.py", SOURCE.replace("3", "4"))
    again, second = copy.pytest([*run, "test_sizes.py"], timeout=60.0)
    assert code == again == 0
    parent, *_ = first.split()
    assert first.split()[1:4] == ["False", "3", str(copy.root / "sizes.py")]
    assert second.split()[:4] == [parent, "True", "4", str(copy.root / "sizes.py")]
