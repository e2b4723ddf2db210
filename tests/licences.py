"""The packages that the project needs, and their licences, as the installed packages state them.

``python tests/licences.py`` prints the tables of the page *About*.
"""

import re
import sys
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement

ROOT = Path(__file__).parents[1]

_SHORT = {
    "MIT License": "MIT",
    "MIT": "MIT",
    "Apache 2.0": "Apache-2.0",
    "Apache Software License": "Apache-2.0",
    "BSD": "BSD",
    "BSD License": "BSD",
    "BSD 2-Clause License": "BSD-2-Clause",
    "BSD 3-Clause License": "BSD-3-Clause",
    "Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
    "Python Software Foundation License": "PSF-2.0",
    "GNU General Public License v2 (GPLv2)": "GPL-2.0",
    "GPLv2-or-later with a special exception which allows to use PyInstaller to build and "
    "distribute non-free programs (including commercial ones)": "GPL-2.0-or-later with exception",
    "The Unlicense (Unlicense)": "Unlicense",
    "MIT No Attribution License (MIT-0)": "MIT-0",
    "Public Domain": "Public domain",
}
"""The usual short names, where a package writes its licence otherwise."""


def key(name: str) -> str:
    """Write a package's name as registries compare it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def project() -> dict[str, Any]:
    """Read what the project says of itself."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    described: dict[str, Any] = tomllib.loads(text)
    return described


def direct() -> dict[str, list[str]]:
    """Return the requirements that the project itself names, by the name of their group."""
    described = project()
    found = described["project"]
    extras = found["optional-dependencies"]
    return {
        "run": found["dependencies"],
        **{name: list(_expanded(extra, extras)) for name, extra in extras.items()},
        "build": described["build-system"]["requires"],
    }


def _expanded(requirements: Iterable[str], extras: Mapping[str, list[str]]) -> Iterator[str]:
    """Replace the project's own extras by what these require."""
    for each in requirements:
        asked = Requirement(each)
        if key(asked.name) == "occ-explorer":
            for extra in asked.extras:
                yield from _expanded(extras[extra], extras)
        else:
            yield each


@cache
def groups() -> dict[str, set[str]]:
    """Return the groups that name a package, by the package."""
    found: dict[str, set[str]] = {}
    for group, requirements in direct().items():
        for requirement in requirements:
            found.setdefault(key(Requirement(requirement).name), set()).add(group)
    return found


@cache
def indirect() -> dict[str, set[str]]:
    """Return the packages that those need in turn, on this system, and who needs each."""
    needed: dict[str, set[str]] = {}
    waiting = [Requirement(each) for group in direct().values() for each in group]
    seen: set[str] = set()
    while waiting:
        asked = waiting.pop()
        if str(asked) in seen:
            continue
        seen.add(str(asked))
        for each in _needs(asked):
            needed.setdefault(key(each.name), set()).add(key(asked.name))
            waiting.append(each)
    return {name: by for name, by in needed.items() if name not in groups()}


def _needs(asked: Requirement) -> Iterator[Requirement]:
    package = installed(asked.name)
    extras = ["", *asked.extras]
    for each in map(Requirement, (package and package.requires) or ()):
        if each.marker is None or any(each.marker.evaluate({"extra": e}) for e in extras):
            yield each


def installed(name: str) -> Distribution | None:
    """Return an installed package, None where it is not."""
    try:
        return distribution(name)
    except PackageNotFoundError:
        return None


def licence(name: str) -> str | None:
    """Return the licence that an installed package states, None where it is not installed."""
    package = installed(name)
    if package is None:
        return None
    about = package.metadata
    stated = (about.get_all("License-Expression") or [""])[0]
    if not stated:
        text = (about.get_all("License") or [""])[0].strip()
        # Some give the whole text in place of the name.
        stated = "" if "\n" in text or text == "UNKNOWN" else text
    if not stated:
        marks = about.get_all("Classifier") or []
        named = [mark.rpartition(" :: ")[2] for mark in marks if mark.startswith("License :: ")]
        stated = " or ".join(_SHORT.get(each, each) for each in named)
    return _SHORT.get(stated, stated) or "not stated"


def rows(packages: Mapping[str, set[str]]) -> list[tuple[str, str, str]]:
    """Return name, licence, and by what each is needed."""
    return [
        (name, licence(name) or "not installed", ", ".join(sorted(by)))
        for name, by in sorted(packages.items())
    ]


def main() -> None:
    """Print both tables."""
    for packages in (groups(), indirect()):
        for row in rows(packages):
            sys.stdout.write(f"| {' | '.join(row)} |\n")
        sys.stdout.write("\n")


if __name__ == "__main__":
    main()
