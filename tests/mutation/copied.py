"""A copy of the project, in which mutants live; the user's files are never touched."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib.util import cache_from_source
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Copy:
    """A folder with the project in it as it is on the disk, committed or not."""

    root: Path

    def write(self, file: str, text: str) -> None:
        """Replace a file, and drop what is compiled of it: it may be of the same time and size."""
        path = self.root / file
        path.write_text(text, encoding="utf-8", newline="")
        Path(cache_from_source(str(path))).unlink(missing_ok=True)

    def run(self, arguments: Sequence[str], seconds: float = 3600.0) -> tuple[int | None, str]:
        """Run Python in the copy: exit code, or None where it takes longer, and what it printed.

        All processes that this one starts import the copy too, and end with it.
        """
        environment = {**os.environ, "PYTHONPATH": str(self.root), "PYTHONDONTWRITEBYTECODE": ""}
        with subprocess.Popen(
            [sys.executable, *arguments],
            cwd=self.root,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        ) as process:
            try:
                printed, _ = process.communicate(timeout=seconds)
            except subprocess.TimeoutExpired:
                return None, "timeout"
            finally:
                with suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)
        return process.returncode, printed


@contextmanager
def copy_of_project() -> Iterator[Copy]:
    """Make a copy of what git knows or would add, and remove it in the end."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, capture_output=True, check=True, text=True,
    )  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="mutants-", ignore_cleanup_errors=True) as folder:
        copy = Path(folder).resolve() / "project"
        for name in filter(None, listed.stdout.split("\0")):
            if (ROOT / name).is_file():
                (copy / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, copy / name)
        # The real photographs are looked for beside the project.
        if (ROOT.parent / "shared").exists():
            (copy.parent / "shared").symlink_to((ROOT.parent / "shared").resolve())
        yield Copy(copy)
