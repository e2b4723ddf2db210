"""A copy of the project, in which mutants live; the user's files are never touched."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

_TIMED_OUT = 124


@dataclass
class Copy:
    """A folder with the project in it as it is on the disk, committed or not."""

    root: Path
    _clock: Iterator[int] = field(default_factory=lambda: count(1_000_000_000, 10))
    _process: subprocess.Popen[str] | None = None

    def write(self, file: str, text: str) -> None:
        """Replace a file.

        Each time it gets another time of change, as Python takes a compiled file of the same time
        and size for that of the new source.
        """
        path = self.root / file
        path.write_text(text, encoding="utf-8", newline="")
        moment = next(self._clock)
        os.utime(path, (moment, moment))

    def run(
        self, arguments: Sequence[str], timeout: float, settings: Mapping[str, str] | None = None
    ) -> tuple[int, str]:
        """Run Python in the copy: exit code and what it printed.

        All processes that this one starts import the copy too, and end with it.
        """
        environment = {**os.environ, **(settings or {}), "PYTHONPATH": str(self.root)}
        self._process = process = subprocess.Popen(
            [sys.executable, *arguments],
            cwd=self.root,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        try:
            printed, _ = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            return _TIMED_OUT, "timeout"
        finally:
            _end(process)
        return process.returncode, printed

    def stop(self) -> None:
        """End what runs in the copy."""
        if self._process is not None:
            _end(self._process)


def _end(process: subprocess.Popen[str]) -> None:
    """End a process and all that it has started and left."""
    if hasattr(os, "killpg"):
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()
    if process.stdout is not None:
        process.stdout.close()


@contextmanager
def copy_of_project(root: Path = ROOT) -> Iterator[Copy]:
    """Make a copy of what git knows or would add, and remove it in the end."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root, capture_output=True, check=True, text=True,
    )  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="mutants-", ignore_cleanup_errors=True) as folder:
        copy = Path(folder).resolve() / "project"
        for name in filter(None, listed.stdout.split("\0")):
            if (root / name).is_file():
                (copy / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(root / name, copy / name)
        # The real photographs are looked for beside the project.
        if (root.parent / "shared").exists():
            (copy.parent / "shared").symlink_to((root.parent / "shared").resolve())
        yield Copy(copy)
