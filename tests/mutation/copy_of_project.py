"""A copy of the project, in which mutants live; the user's files are never touched."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

from mutation.runner import TIMED_OUT, end_group

ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Copy:
    """A folder with the project in it as it is on the disk, committed or not."""

    root: Path
    _clock: Iterator[int] = field(default_factory=lambda: count(1_000_000_000, 10))
    _process: subprocess.Popen[str] | None = None
    _runner: subprocess.Popen[str] | None = None
    _child: int = 0

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
            return TIMED_OUT, "timeout"
        finally:
            _end(process)
        return process.returncode, printed

    def pytest(self, arguments: Sequence[str], timeout: float) -> tuple[int, str]:
        """Run pytest in the copy: exit code and what it printed.

        Where the system can fork, a process that has others' packages imported already does it.
        """
        if not hasattr(os, "fork"):
            return self.run(["-m", "pytest", *arguments], timeout)
        if self._runner is None or self._runner.poll() is not None:
            self._runner = self._new_runner()
        asked, told = self._runner.stdin, self._runner.stdout
        assert asked is not None
        assert told is not None
        printed, imported = (self.root.parent / name for name in ("printed.txt", "imported.json"))
        imported.unlink(missing_ok=True)
        command = {
            "arguments": [*arguments], "seconds": timeout,
            "printed": str(printed), "imported": str(imported),
        }  # fmt: skip
        asked.write(json.dumps(command) + "\n")
        asked.flush()
        self._child = int(told.readline())
        code = int(told.readline())
        self._child = 0
        return code, printed.read_text(encoding="utf-8", errors="replace")

    def _new_runner(self) -> subprocess.Popen[str]:
        environment = {**os.environ, "PYTHONPATH": str(self.root)}
        return subprocess.Popen(
            [sys.executable, str(Path(__file__).with_name("runner.py"))],
            cwd=self.root,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def stop(self) -> None:
        if self._child:
            end_group(self._child)
        for process in (self._process, self._runner):
            if process is not None:
                _end(process)


def _end(process: subprocess.Popen[str]) -> None:
    """End a process and all that it has started and left."""
    if hasattr(os, "killpg"):
        end_group(process.pid)
    else:
        process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with suppress(BrokenPipeError):
                stream.close()


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
        result = Copy(copy)
        try:
            yield result
        finally:
            result.stop()
