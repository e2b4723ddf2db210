"""No process of the program listens on a network socket, not even for sweeps and films."""

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from sockets import find_open_sockets, processes_of

WORK = """
import sys
import occ_model as occ

def wait(done, *_):
    if done == 1:
        print("at work", flush=True)
        sys.stdin.readline()

def main():
    scene = occ.load_preset("phone-68us").replace(rows=60, columns=600)
    occ.write_video(occ.render_video(scene, 3), sys.argv[1])
    frames = iter(occ.load_video(sys.argv[1]))
    next(frames)
    occ.sweep(scene, {"iso": [100, 200, 300, 400]}, 2, path="image", jobs=2, progress=wait)

if __name__ == "__main__":
    main()
"""


@contextmanager
def run_program(folder: Path, *words: str) -> Iterator[tuple[int, str]]:
    """Run the program up to the line that it prints; yield its session and the line."""
    path = folder / "at_work.py"
    path.write_text(WORK, encoding="utf-8")
    with subprocess.Popen(
        [sys.executable, path, *words],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, start_new_session=True,
    ) as running:  # fmt: skip
        try:
            yield running.pid, running.stdout.readline().strip()
        finally:
            with suppress(ProcessLookupError):
                os.killpg(running.pid, signal.SIGKILL)


def test_an_open_socket_is_detected(tmp_path: Path) -> None:
    here = os.getpid()
    assert not [name for name in find_open_sockets(here) if "00000000" in name]
    with socket.socket() as listener, socket.socket(socket.AF_UNIX) as local:
        listener.bind(("", 0))
        listener.listen()
        local.bind("\0" + tmp_path.name)
        local.listen()
        port = f"{listener.getsockname()[1]:04X}"
        assert {f"tcp 00000000:{port}", f"unix @{tmp_path.name}"} <= {*find_open_sockets(here)}


def test_working_processes_listen_nowhere(tmp_path: Path) -> None:
    # The program, its decoder, its two workers and the server from which they are forked.
    with run_program(tmp_path, str(tmp_path / "film.mkv")) as (session, said):
        assert said == "at work"
        assert len(processes_of(session)) >= 5
        assert [
            name for process in processes_of(session) for name in find_open_sockets(process)
        ] == []
