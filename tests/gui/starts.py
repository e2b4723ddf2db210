"""Starts of the window's program, each in a process of its own, which share their imports.

Importing takes longer than the rest of a start. One process imports everything, without an
application or a thread; each start is a fork of it, which goes on as a new process would.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

PROJECT = Path(__file__).resolve().parents[2]

_PATIENCE_S = 120
"""After which a start that hangs is ended."""

_IMPORTER = """
import json, os, signal, sys
import occ_gui.app.application, occ_gui.app.command_line, occ_gui.app.display

for line in sys.stdin:
    words, program, environment, patience, *streams = json.loads(line)
    child = os.fork()
    if child:
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
        continue
    signal.alarm(patience)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    for number, path in enumerate(streams, 1):
        os.dup2(os.open(path, os.O_WRONLY), number)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = words
    exec(program, {"__name__": "__main__"})
    sys.exit()
"""

WINDOW = """
import sys
from occ_gui.__main__ import main
sys.exit(main())
"""
"""What ``python -m occ_gui`` does."""

UNMEASURED = """
import sys
from occ_gui.__main__ import main
from occ_gui.detection_map.wiring import BackgroundRates

BackgroundRates.is_idle, BackgroundRates._begin = True, lambda measuring: None
sys.exit(main())
"""
"""The same without the rates beside the sliders, which a screenshot waits half a minute for."""


class Starts:
    """Starts programs, after what they need has been imported once."""

    def __init__(self) -> None:
        self._folder = TemporaryDirectory()
        self._streams = [Path(self._folder.name, name) for name in ("out", "error")]
        self._importer = subprocess.Popen(
            [sys.executable, "-c", _IMPORTER],
            cwd=PROJECT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        )  # fmt: skip

    def run(
        self, *words: str | Path, program: str = WINDOW, **environment: str
    ) -> subprocess.CompletedProcess[str]:
        """Run a program, by default the window's, to its end, with some variables set beside."""
        here = {**os.environ, "QT_QPA_PLATFORM": "offscreen", **environment}
        argv = ["occ-gui", *map(str, words)]
        for stream in self._streams:
            stream.write_bytes(b"")
        asked = [argv, program, here, _PATIENCE_S, *map(str, self._streams)]
        assert self._importer.stdin is not None
        print(json.dumps(asked), file=self._importer.stdin, flush=True)
        code = int(self._importer.stdout.readline())
        out, error = (stream.read_text("utf-8") for stream in self._streams)
        return subprocess.CompletedProcess(argv, code, out, error)

    def close(self) -> None:
        self._importer.communicate()
        self._folder.cleanup()
