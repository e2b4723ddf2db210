"""A process that runs pytest again and again in children of itself, which start at once.

``python runner.py`` reads a command a line and answers with two: the child's number, then its exit
code. A child begins with all that earlier ones have imported of others' packages; the project and
its tests it imports anew, as a fault may be in them.
"""

import importlib
import json
import os
import signal
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

TIMED_OUT = 124

_ARE_INSTALLED = ("site-packages", "dist-packages", "PySide6", "shiboken6")


def _runs(command: dict[str, Any]) -> NoReturn:
    """Run pytest in this child, write what it prints to a file, and end."""
    os.setsid()
    printed = os.open(command["printed"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    nothing = os.open(os.devnull, os.O_RDONLY)
    for there, here in ((nothing, 0), (printed, 1), (printed, 2)):
        os.dup2(there, here)
    code = 3
    try:
        import pytest

        code = int(pytest.main(command["arguments"]))
        Path(command["imported"]).write_text(json.dumps(_installed()), encoding="utf-8")
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        # Nothing that the parent has registered for its own end is to run here.
        os._exit(code)


def _installed() -> list[str]:
    """Name what is imported of packages that are installed, the first ones first."""
    files = {name: getattr(module, "__file__", None) for name, module in sys.modules.items()}
    return [
        name
        for name, file in files.items()
        if file and any(part in Path(file).parts for part in _ARE_INSTALLED)
    ]


def _import(names: list[str]) -> None:
    """Import what children need, so that the next ones have it from the start."""
    for name in names:
        if name not in sys.modules:
            # What only a test's own settings let it import stays for the tests.
            with suppress(Exception):
                importlib.import_module(name)


def end_group(leader: int) -> None:
    """End all processes that one has started, with itself."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(leader, signal.SIGKILL)


def _awaited(child: int, seconds: float) -> int:
    """Wait for a child, and end it and all that it has left: its exit code."""
    late = []

    def end(*_: object) -> None:
        late.append(child)
        end_group(child)

    signal.signal(signal.SIGALRM, end)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    _, status = os.waitpid(child, 0)
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    end_group(child)
    return TIMED_OUT if late else os.waitstatus_to_exitcode(status)


def main() -> None:
    """Serve one command after another until there are no more."""
    # As if pytest were run as a module: from the folder that this process is in.
    sys.path[0] = str(Path.cwd())
    for line in sys.stdin:
        command = json.loads(line)
        child = os.fork()
        if not child:
            _runs(command)
        print(child, flush=True)
        code = _awaited(child, command["seconds"])
        imported = Path(command["imported"])
        if imported.exists():
            _import(json.loads(imported.read_text(encoding="utf-8")))
            imported.unlink()
        print(code, flush=True)


if __name__ == "__main__":
    main()
