"""The page of licences names every package, with the licence that it states of itself."""

import re
import subprocess
import sys

import pytest
from documents import FOLDER, text_of
from licences import direct, groups, indirect, installed, licence

PAGE = FOLDER / "about.md"
AGAIN = "`python tests/licences.py` prints the tables anew"


def table(heading: str) -> dict[str, list[str]]:
    """Read the cells of a table by its first column."""
    part = text_of(PAGE).partition(f"\n### {heading}\n")[2].partition("\n### ")[0]
    rows = [line.strip("| ").split(" | ") for line in part.splitlines() if line.startswith("| ")]
    return {cells[0]: cells[1:] for cells in rows[1:]}


NAMED = table("Packages that the project names")
NEEDED = table("Packages that those need")


def test_the_packages_of_the_project_are_listed_with_what_they_are_for() -> None:
    assert NAMED.keys() == groups().keys(), AGAIN
    for name, (_, groups_of_it, use) in NAMED.items():
        assert groups_of_it == ", ".join(sorted(groups()[name])), AGAIN
        assert use


def test_the_packages_that_those_need_are_listed() -> None:
    found = indirect()
    assert found.keys() <= NEEDED.keys(), AGAIN
    # Another system, or an extra that is not installed, needs others.
    assert [name for name in NEEDED.keys() - found.keys() if installed(name)] == [], AGAIN


def family(stated: str | None) -> str:
    """Return the kind of a package's first licence: its wording differs from version to version."""
    return re.split(r"[-. ]", stated or "")[0]


@pytest.mark.parametrize("packages", [NAMED, NEEDED], ids=["named", "needed"])
def test_each_has_the_licence_that_it_states(packages: dict[str, list[str]]) -> None:
    stated = {name: family(licence(name)) for name in packages if installed(name)}
    assert {name: family(packages[name][0]) for name in stated} == stated, AGAIN
    assert not {"", "not stated", "not installed"} & {cells[0] for cells in packages.values()}


def test_every_run_time_package_is_installed() -> None:
    names = [re.split(r"[\[<>=!~; ]", each)[0] for each in direct()["run"]]
    assert [name for name in names if installed(name) is None] == []


@pytest.mark.whole
def test_no_installed_package_contradicts_another() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "pip", "check", "--disable-pip-version-check"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout, done.stderr) == (0, "No broken requirements found.\n", "")
