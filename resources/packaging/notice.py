"""Write the notice of a bundle, ``NOTICE.txt``: its packages, with the texts of their licences."""

import platform
import re
import shutil
import sysconfig
from collections.abc import Collection, Iterable
from importlib.metadata import Distribution, distributions
from os.path import normpath
from pathlib import Path

OWN = "occ-explorer"
_STANDARD_LIBRARY = Path(sysconfig.get_path("stdlib"))
_LICENCE_TEXT = re.compile(
    r"(licen[cs]e|copying|notice|authors)[^.]*(\.(txt|md|rst|apache|bsd|mit))?", re.IGNORECASE
)


REMARKS = {
    "av": "its libraries are FFmpeg (LGPL 3 or later), linked to the encoders x264 and x265 "
    "(GPL 2 or later): who passes on this folder does so as a whole under the GPL 3 or later, with "
    "its text and with the sources of these libraries",
}
"""Remarks on parts of packages that are under other licences than the packages state."""


def write_notice(sources: Collection[Path], bundle: Path, project: Path) -> None:
    """List the packages of a bundle made from ``sources``, with version and licence."""
    texts = bundle / "licences"
    texts.mkdir()
    shutil.copy(project / "LICENSE", texts / f"{OWN}.txt")
    packages, others = packages_of(sources)
    version = packages.pop(OWN).version
    lines = [
        f"{OWN} {version} is under the MIT licence: licences/{OWN}.txt",
        "",
        "This folder also holds these packages, as a whole or in part, each with the licence that",
        "it states. Some hold compiled libraries of others; what a package says of them is in its",
        "texts.",
        "",
        *(_line(packages[name], texts) for name in sorted(packages, key=str.lower)),
        _line_of_python(texts),
    ]
    if libraries := system_libraries(others, project):
        heading = (
            "And these libraries of the system that it was made on, which states their licences:"
        )
        lines += ["", heading, "", *libraries]
    (bundle / "NOTICE.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def packages_of(sources: Iterable[Path]) -> tuple[dict[str, Distribution], list[Path]]:
    """Return the installed packages that the files belong to, and the files of none."""
    owners = {}
    for package in distributions():
        # Resolved once, not for each of tens of thousands of files.
        root = Path(str(package.locate_file(""))).resolve()
        owners |= dict.fromkeys((normpath(root / each) for each in package.files or ()), package)
    found: dict[str, Distribution] = {}
    others = []
    for source in sources:
        owner = owners.get(str(source.resolve()))
        if owner is None:
            others.append(source)
        else:
            found[owner.name] = owner
    return found, others


def licence(package: Distribution) -> str:
    """Return the licence that a package states."""
    about = package.metadata
    for field in ("License-Expression", "License"):
        stated = (about.get_all(field) or [""])[0].strip()
        # Some packages give the whole text in place of the name.
        if stated and stated != "UNKNOWN" and "\n" not in stated:
            return stated
    marks = (mark.split(" :: ") for mark in about.get_all("Classifier") or ())
    return ", ".join(mark[-1] for mark in marks if mark[0] == "License") or "not stated"


def system_libraries(files: Iterable[Path], project: Path) -> list[str]:
    """Return the names of files that belong neither to the project nor to Python."""
    return sorted(
        file.name
        for file in files
        if not file.is_relative_to(project)
        and not file.is_relative_to(_STANDARD_LIBRARY)
        and not file.name.startswith("libpython")
    )


def _line(package: Distribution, texts: Path) -> str:
    """Copy the texts of a package's licence; return its line in the notice."""
    folder = texts / f"{package.name}-{package.version}"
    copied = [file for file in package.files or () if _LICENCE_TEXT.fullmatch(file.name)]
    for text in copied:
        folder.mkdir(exist_ok=True)
        name = "-".join(text.parts[-2:]) if len(copied) > 1 else text.name
        shutil.copy(str(text.locate()), folder / name)
    place = f"licences/{folder.name}" if copied else "it brings no text"
    remark = f"; {REMARKS[package.name]}" if package.name in REMARKS else ""
    return f"{package.name} {package.version}: {licence(package)} ({place}){remark}"


def _line_of_python(texts: Path) -> str:
    text = _STANDARD_LIBRARY / "LICENSE.txt"
    if text.is_file():
        shutil.copy(text, texts / "Python.txt")
    place = "licences/Python.txt" if text.is_file() else "it brings no text"
    return f"Python {platform.python_version()}: PSF-2.0 ({place})"
