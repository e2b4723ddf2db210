"""Make a folder that runs without Python: both programs, their libraries, icon and licences.

    python resources/packaging/build.py [--to FOLDER]

The folder is for the platform on which it is made. The extra ``package`` installs what is needed.
On Linux the folder ``share`` contains the files by which a desktop lists the program.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from notice import write_notice

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
NAME = "occ-explorer"


def main() -> int:
    """Build the bundle; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--to", type=Path, default=ROOT / "dist", metavar="FOLDER")
    target: Path = parser.parse_args().to.resolve()
    with tempfile.TemporaryDirectory() as work:
        icon = draw_icon(Path(work))
        sources = run_pyinstaller(target, Path(work), icon)
        if sys.platform == "linux":
            add_desktop_files(target / NAME, icon)
    write_notice(sources, target / NAME, ROOT)
    print(f"{target / NAME}: {megabytes(target / NAME):.0f} MB")
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


def run_pyinstaller(target: Path, work: Path, icon: Path) -> list[Path]:
    """Collect the programs and all that they import; return the collected files."""
    command = [sys.executable, "-m", "PyInstaller", "--noconfirm", "--log-level", "WARN"]
    folders = ["--distpath", str(target), "--workpath", str(work / "work")]
    subprocess.run(
        [*command, *folders, str(HERE / f"{NAME}.spec")],
        check=True,
        cwd=ROOT,
        env={**os.environ, "OCC_ICON": str(icon), "OCC_CONTENTS": str(work / "contents")},
    )
    files = map(Path, (work / "contents").read_text(encoding="utf-8").splitlines())
    return [file for file in files if file.is_absolute() and not file.is_relative_to(work)]


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


def megabytes(folder: Path) -> float:
    """Return the size of a folder's files in megabytes."""
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) / 1e6


if __name__ == "__main__":
    raise SystemExit(main())
