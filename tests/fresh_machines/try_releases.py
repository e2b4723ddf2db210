"""Try the README's two commands in a clean root of each Debian release; print a table.

    python3 tests/fresh_machines/try_releases.py [--keep FOLDER] [RELEASE ...]

Each root holds Python and nothing else: the last commit is copied into it, with pip's settings of
this machine. Needed are root, a network, and ``apt-get install mmdebstrap``; a release takes some
ten minutes and 4 GB. `resources/docs/validation.md` has the result.
"""

import argparse
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
RELEASES = ("bookworm", "trixie", "forky")
"""Debian 12, 13 and the next one."""

INCLUDED = "python3,python3-venv,ca-certificates"
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
HOME, INSIDE, WINDOW = "/root", "/root/project", "window.png"
COMMANDS = (("--screenshot", WINDOW), ("test",))
"""The README's two commands; a root has no display, so the first draws its window as a picture."""

TITLES = (
    "release", "Python", "numpy", "Qt", "window, s", "tests, s", "passed", "failed", "skipped",
)  # fmt: skip
SUMMARY = re.compile(r"^=+ (.* passed.*) in .*=+$", re.MULTILINE)
COUNT = re.compile(r"(\d+) (passed|failed|skipped|errors?)")


def main() -> int:
    """Try the releases; return 0 if all passed in each."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("releases", nargs="*", metavar="RELEASE", default=RELEASES)
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="keep roots and logs here")
    options = parser.parse_args()
    if os.geteuid() != 0:
        sys.exit("Making and entering a root needs root: start this with sudo.")
    if shutil.which("mmdebstrap") is None:
        sys.exit("mmdebstrap is missing: apt-get install mmdebstrap")
    # Leave by the way that unmounts what was mounted.
    signal.signal(signal.SIGTERM, lambda number, _frame: sys.exit(128 + number))
    with ExitStack() as stack:
        folder = options.keep or Path(stack.enter_context(tempfile.TemporaryDirectory()))
        rows = [try_release(release, folder.resolve()) for release in options.releases]
    for cells in (TITLES, ("---",) * len(TITLES), *rows):
        print(f"| {' | '.join(cells)} |")
    return 0 if all(row[-2] == "0" for row in rows) else 1


def try_release(release: str, folder: Path) -> tuple[str, ...]:
    """Run both commands in a new root of a release; return its row of the table."""
    root = folder / release
    make_root(release, root)
    times, output = [], ""
    with mounted(root):
        for arguments in COMMANDS:
            print(f"{release}: start.py {' '.join(arguments)}", file=sys.stderr, flush=True)
            begin = time.monotonic()
            log = folder / f"{release}-{arguments[0].lstrip('-')}.log"
            code = run_inside(root, ["python3", "resources/start.py", *arguments], log)
            output = log.read_text(errors="replace")
            times.append(f"{time.monotonic() - begin:.0f}")
            if code != 0:
                times[-1] += f" (exit code {code})"
        parts = versions(root, folder / f"{release}-versions.log")
    summary = "".join(SUMMARY.findall(output)[-1:])  # other checks count errors of theirs
    counts = {name.rstrip("s"): number for number, name in COUNT.findall(summary)}
    failed = int(counts.get("failed", 0)) + int(counts.get("error", 0))
    is_whole = "Every check passed." in output and (root / INSIDE[1:] / WINDOW).is_file()
    verdict = str(failed) if failed or is_whole else "see the log"
    tests = (counts.get("passed", "0"), verdict, counts.get("skipped", "0"))
    return (release, *parts, *times, *tests)


def make_root(release: str, root: Path) -> None:
    """Make a root of a release anew, with a copy of the last commit and pip's settings."""
    shutil.rmtree(root, ignore_errors=True)
    root.parent.mkdir(parents=True, exist_ok=True)
    old_dates = ['--aptopt=Acquire::Check-Valid-Until "false"']
    make = ["mmdebstrap", "--quiet", "--variant=apt", f"--include={INCLUDED}", *old_dates]
    subprocess.run([*make, release, str(root)], check=True)
    archive = subprocess.run(
        ["git", "archive", "HEAD"], cwd=PROJECT, check=True, capture_output=True
    ).stdout
    with tarfile.open(fileobj=io.BytesIO(archive)) as files:
        files.extractall(root / INSIDE[1:], filter="data")
    lines = ["[global]"]
    for name, value in pip_settings().items():
        lines.append(f"{name} = {value}")
        if Path(value).is_file():  # certificates
            copy = root / value.lstrip("/")
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(value, copy)
    (root / "etc/pip.conf").write_text("\n".join(lines) + "\n")


def pip_settings() -> dict[str, str]:
    """Return pip's settings on this machine, but for folders, of which a root has none."""
    command = [sys.executable, "-m", "pip", "config", "list"]
    listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    pairs = (line.partition("=") for line in listed.splitlines())
    settings = {name.rpartition(".")[2]: value.strip("'\"") for name, _, value in pairs}
    return {
        name: value
        for name, value in settings.items()
        if not (value.startswith("file:") or Path(value).is_dir())
    }


@contextmanager
def mounted(root: Path) -> Iterator[None]:
    """Mount what programs expect of a system while they run in a root."""
    shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")
    with ExitStack() as stack:
        for kind, place in (("proc", "proc"), ("sysfs", "sys"), ("tmpfs", "dev/shm")):
            target = str(root / place)
            Path(target).mkdir(parents=True, exist_ok=True)
            subprocess.run(["mount", "-t", kind, kind, target], check=True)
            stack.callback(subprocess.run, ["umount", "--lazy", target], check=False)
        yield


def run_inside(root: Path, command: Sequence[str], log: Path) -> int:
    """Run a command in the project's folder of a root; return its exit code."""
    empty = ["env", "-i", f"HOME={HOME}", f"PATH={PATH}", "LANG=C.UTF-8"]
    enter = ["chroot", str(root), *empty, "sh", "-c", f'cd {INSIDE} && exec "$@"', "sh"]
    with (
        log.open("wb") as file,
        subprocess.Popen(
            [*enter, *command], stdout=file, stderr=file, start_new_session=True
        ) as program,
    ):
        try:
            return program.wait()
        except BaseException:  # ended by a signal: what the command has started ends, too
            os.killpg(program.pid, signal.SIGKILL)
            raise


def versions(root: Path, log: Path) -> tuple[str, str, str]:
    """Return the versions of Python, numpy and Qt that a root's set-up chose."""
    ask = (
        "import sys; from importlib.metadata import version; "
        "print(sys.version.split()[0], version('numpy'), version('PySide6-Essentials'))"
    )
    code = run_inside(root, [".venv/bin/python", "-c", ask], log)
    python, numpy, qt = log.read_text().split() if code == 0 else ("?", "?", "?")
    return python, numpy, qt


if __name__ == "__main__":
    sys.exit(main())
