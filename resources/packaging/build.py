"""Make a folder that runs without Python: both programs, their libraries, icon and licences.

    python resources/packaging/build.py [--to FOLDER]

It is made for the platform that it is made on. The extra ``package`` brings what is needed. On
Linux the folder also has what a desktop needs to list the program, in ``share``.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Iterator
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
NAME = "occ-explorer"
WINDOW_EXTRA = re.compile(r"""extra == ['"]gui['"]""")
LICENCE_FILE = re.compile(r"(licen[cs]e|copying|notice|authors)", re.IGNORECASE)


def main() -> int:
    """Build the bundle; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--to", type=Path, default=ROOT / "dist", metavar="FOLDER")
    target: Path = parser.parse_args().to.resolve()
    with tempfile.TemporaryDirectory() as work:
        icon = draw_icon(Path(work))
        run_pyinstaller(target, Path(work), icon)
        if sys.platform == "linux":
            add_desktop_files(target / NAME, icon)
    missing = add_licences(target / NAME / "licences")
    print(f"{target / NAME}: {megabytes(target / NAME):.0f} MB")
    print("Packages without a licence text of their own:", ", ".join(missing) or "none")
    return 0


def draw_icon(folder: Path) -> Path:
    """Draw the program's icon in the format of this platform, and return its path."""
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    from PIL import Image
    from PySide6.QtGui import QGuiApplication

    from occ_gui.widgets.icons import PROGRAM, PROGRAM_SIZES, program_icon

    application = QGuiApplication([])
    side = PROGRAM_SIZES[-1]
    path = folder / f"{PROGRAM}.png"
    program_icon().pixmap(side).save(str(path))
    application.shutdown()
    endings = {"win32": ".ico", "darwin": ".icns"}
    if sys.platform in endings:
        drawn = path.with_suffix(endings[sys.platform])
        Image.open(path).save(drawn, sizes=[(size, size) for size in PROGRAM_SIZES])
        return drawn
    return path


def run_pyinstaller(target: Path, work: Path, icon: Path) -> None:
    """Gather the programs and all that they import."""
    command = [sys.executable, "-m", "PyInstaller", "--noconfirm", "--log-level", "WARN"]
    folders = ["--distpath", str(target), "--workpath", str(work / "work")]
    subprocess.run(
        [*command, *folders, str(HERE / f"{NAME}.spec")],
        check=True,
        cwd=ROOT,
        env={**os.environ, "OCC_ICON": str(icon)},
    )


def add_desktop_files(bundle: Path, icon: Path) -> None:
    """Add the desktop entry, the description for software centres, the file type, the icon."""
    linux = HERE / "linux"
    for source, place in (
        (linux / f"{NAME}.desktop", "applications"),
        (linux / f"{NAME}.metainfo.xml", "metainfo"),
        (linux / f"{NAME}.xml", "mime/packages"),
        (icon, "icons/hicolor/256x256/apps"),
    ):
        folder = bundle / "share" / place
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, folder / source.name)


def add_licences(folder: Path) -> list[str]:
    """Copy the licence texts of all that the bundle contains; name packages that have none."""
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(ROOT / "LICENSE", folder / f"{NAME}.txt")
    missing = []
    for package in contained(NAME):
        texts = [file for file in package.files or () if is_licence(str(file))]
        for text in texts:
            name = "-".join(text.parts[-2:]) if len(texts) > 1 else text.name
            copied = folder / f"{package.name}-{package.version}" / name
            copied.parent.mkdir(exist_ok=True)
            shutil.copy(str(text.locate()), copied)
        if not texts:
            missing.append(f"{package.name} ({package.metadata.get('License', 'not stated')})")
    python = Path(sysconfig.get_path("stdlib")) / "LICENSE.txt"
    if python.is_file():
        shutil.copy(python, folder / "Python.txt")
    return missing


def is_licence(path: str) -> bool:
    """Tell a licence text from a package's other files."""
    name = Path(path).name
    is_text = Path(path).suffix.lower() in ("", ".txt", ".md", ".rst", ".apache", ".bsd", ".mit")
    return is_text and LICENCE_FILE.match(name) is not None


def contained(name: str) -> Iterator[Distribution]:
    """List the packages that a package needs, directly or not, and that are installed here."""
    waiting, seen = [name], {name}
    while waiting:
        package = distribution(waiting.pop())
        if package.name != name:
            yield package
        for requirement in package.requires or ():
            needed = re.split(r"[\s;<>=!~\[(]", requirement, maxsplit=1)[0].lower()
            is_window = package.name == NAME and WINDOW_EXTRA.search(requirement)
            if needed in seen or ("extra ==" in requirement and not is_window):
                continue
            seen.add(needed)
            try:
                distribution(needed)
            except PackageNotFoundError:  # for another platform or version
                continue
            waiting.append(needed)


def megabytes(folder: Path) -> float:
    """Return the size of a folder."""
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) / 1e6


if __name__ == "__main__":
    raise SystemExit(main())
