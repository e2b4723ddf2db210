"""The notice of a bundle names what is in it, and the packages fit each other."""

import importlib.util
import subprocess
import sys
import sysconfig
from importlib.metadata import distribution
from pathlib import Path
from types import ModuleType

import pytest

import occ_model as occ

ROOT = Path(__file__).parents[2]


@pytest.fixture
def notice() -> ModuleType:
    spec = importlib.util.spec_from_file_location("notice", ROOT / "resources/packaging/notice.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def install(folder: Path, name: str, stated: str, *files: str) -> Path:
    """Put a package there, and return its module."""
    about = folder / f"{name}-1.0.dist-info"
    about.mkdir(parents=True)
    about.joinpath("METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n{stated}"
    )
    for file in (f"{name}.py", *files):
        folder.joinpath(file).write_text(name)
    about.joinpath("RECORD").write_text("".join(f"{file},,\n" for file in (f"{name}.py", *files)))
    return folder / f"{name}.py"


def test_the_notice_names_what_the_bundle_holds_and_nothing_else(
    notice: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    site, bundle = tmp_path / "site", tmp_path / "bundle"
    monkeypatch.syspath_prepend(str(site))
    bundle.mkdir()
    named = install(site, "named", "License-Expression: ISC\nLicense: other\n", "LICENSE.txt")
    whole_text = "License: Whole text,\n        of two lines\nClassifier: License :: OSI :: Beer\n"
    without_text = install(site, "without_text", whole_text, "license_plate.py")
    silent = install(site, "silent", "License: UNKNOWN\n")
    install(site, "absent", "License: MIT\n", "COPYING")
    own, *_ = (Path(str(file.locate())) for file in distribution("occ-explorer").files or ())
    library = Path(sysconfig.get_path("stdlib"), "ast.py")
    films = distribution("av")
    (*_, of_films) = (Path(str(file.locate())) for file in films.files or ())
    sources = [silent, own, ROOT / "LICENSE", named, without_text, library, Path("/lib/libz.so.1")]
    sources.append(of_films)

    notice.write_notice(sources, bundle, ROOT)

    first, *lines = (bundle / "NOTICE.txt").read_text(encoding="utf-8").splitlines()
    assert f"occ-explorer {occ.__version__} is under the MIT licence" in first
    start = lines.index("named 1.0: ISC (licences/named-1.0)")
    assert lines[start + 1 : start + 3] == [
        "silent 1.0: not stated (it brings no text)",
        "without_text 1.0: Beer (it brings no text)",
    ]
    assert lines[start + 3].startswith(f"Python {sys.version.split()[0]}: PSF-2.0 ")
    assert lines[start + 6 :] == ["", "libz.so.1"]
    assert "absent" not in "".join(lines)
    assert (bundle / "licences" / "named-1.0" / "LICENSE.txt").read_text() == "named"
    held = {path.name for path in (bundle / "licences").iterdir()} - {"Python.txt"}
    assert held == {"occ-explorer.txt", "named-1.0", f"av-{films.version}"}
    (line,) = (line for line in lines if line.startswith("av "))
    assert "x264 and x265 (GPL 2 or later)" in line


@pytest.mark.whole
def test_no_installed_package_contradicts_another() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "pip", "check", "--disable-pip-version-check"],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout, done.stderr) == (0, "No broken requirements found.\n", "")
