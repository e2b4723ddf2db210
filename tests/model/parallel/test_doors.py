"""No process of ours listens anywhere: not those of sweeps, films, clusters or the window."""

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from sockets import doors, processes_of

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

WINDOW = """
import sys
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.core.workspace import Workspace

def main():
    program = QApplication([])
    application = Application(Workspace(occ.load_preset("phone-68us").replace(rows=100)))
    application.window.show()
    for dock in application.window.docks.values():
        dock.show()

    def wait():
        if application.shell.pane("map").map.full is not None:
            print("at work", flush=True)
            sys.stdin.readline()
            application.window.close()

    timer = QTimer(interval=50, timeout=wait)
    timer.start()
    program.exec()

if __name__ == "__main__":
    main()
"""

CLUSTER = """
import sys
from distributed import LocalCluster
from occ_model.commands.sweep import cluster_executor

def main():
    if sys.argv[1] != "serve":
        with cluster_executor(sys.argv[1]) as executor:
            assert executor.submit(abs, -3).result() == 3
            print("at work", flush=True)
            sys.stdin.readline()
        return
    with LocalCluster(
        n_workers=1, processes=False, protocol="tcp://", dashboard_address=None
    ) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.readline()

if __name__ == "__main__":
    main()
"""


@contextmanager
def at_work(folder: Path, program: str, *words: str) -> Iterator[tuple[int, str]]:
    """Run a program up to the line that it prints; give its session and the line."""
    path = folder / "at_work.py"
    path.write_text(program, encoding="utf-8")
    with subprocess.Popen(
        [sys.executable, path, *words],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, start_new_session=True,
    ) as running:  # fmt: skip
        try:
            yield running.pid, running.stdout.readline().strip()
        finally:
            with suppress(ProcessLookupError):
                os.killpg(running.pid, signal.SIGKILL)


def open_doors(session: int) -> list[str]:
    return [door for process in processes_of(session) for door in doors(process)]


def test_a_door_that_is_open_is_seen(tmp_path: Path) -> None:
    here = os.getpid()
    assert not [door for door in doors(here) if "00000000" in door]
    with socket.socket() as listener, socket.socket(socket.AF_UNIX) as local:
        listener.bind(("", 0))
        listener.listen()
        local.bind("\0" + tmp_path.name)
        local.listen()
        port = f"{listener.getsockname()[1]:04X}"
        assert {f"tcp 00000000:{port}", f"unix @{tmp_path.name}"} <= {*doors(here)}


@pytest.mark.parametrize(
    ("program", "processes"),
    [
        # The program, its decoder, its two workers and the server that they are forked from.
        pytest.param(WORK, 5, id="a sweep and a film"),
        pytest.param(WINDOW, 3, id="the window", marks=pytest.mark.whole),
    ],
)
def test_what_is_at_work_listens_nowhere(tmp_path: Path, program: str, processes: int) -> None:
    with at_work(tmp_path, program, str(tmp_path / "film.mkv")) as (session, said):
        assert said == "at work"
        assert len(processes_of(session)) >= processes
        assert open_doors(session) == []


@pytest.mark.whole
def test_a_cluster_of_this_computer_is_on_loopback_and_its_client_listens_nowhere(
    tmp_path: Path,
) -> None:
    with at_work(tmp_path, CLUSTER, "serve") as (server, address):
        assert address.startswith("tcp://127.0.0.1:")
        listening = [door for door in open_doors(server) if door.startswith("tcp")]
        assert listening
        assert all(door.startswith("tcp 0100007F:") for door in listening)
        with at_work(tmp_path, CLUSTER, address) as (client, said):
            assert said == "at work"
            assert open_doors(client) == []
