"""What reading a camera live takes: a film of 1080p at 30 frames a second stands in for it.

``python tests/benchmarks/live_camera.py`` prints how many pictures came, how many of them were read
and shown, and the processor's time for each. Pictures that nobody had time for are not read: on a
machine that does nothing else, nearly all are.
"""

import os
import sys
import time
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
sys.path.insert(0, str(Path(__file__).parents[1]))

from dataclasses import replace

from film_source import FilmSource
from PySide6.QtCore import QDeadlineTimer, QEventLoop
from PySide6.QtWidgets import QApplication

import occ_model as occ
from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.results import Board
from occ_gui.video.wiring import VideoWiring

SECONDS, RATE, DIFFERENT = 10.0, 30.0, 12
_TURN_MS = 20


def source(scene: occ.Scene) -> FilmSource:
    """Return a film that repeats a few frames; they are simulated before it begins."""
    made = list(occ.render_video(scene, DIFFERENT, occ.Recording(frame_rate=RATE)))
    frames = [
        replace(made[number % DIFFERENT], index=number, time=number / RATE)
        for number in range(round(SECONDS * RATE))
    ]
    return FilmSource(frames, "Film")


def main() -> None:
    application = QApplication([])
    scene = occ.load_preset("phone-136us").replace(
        rows=1080, columns=1920, readout_time=15e-6, distance=0.6
    )
    camera, wiring = source(scene), VideoWiring(SceneStore(Store(Workspace(scene))), Board())
    shown: list[None] = []
    wiring.view.resize(940, 700)
    wiring.view.show()
    wiring.set_seen(True)
    wiring.films.frame_shown.connect(lambda _: shown.append(None))
    wiring.live.start(camera)
    video, read, began = wiring.live.video, 0, time.perf_counter()
    used = time.process_time()
    deadline = QDeadlineTimer(round(2e3 * SECONDS))
    while wiring.live.is_filming and not deadline.hasExpired():
        application.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, _TURN_MS)
        read = max(read, len(wiring.readings.reading.times))
    seconds, used = time.perf_counter() - began, time.process_time() - used
    wiring.stop()
    came = 0 if video is None else video.arrived
    print(f"{came / seconds:.1f} pictures a second came, {read / seconds:.1f} were read")
    print(f"{len(shown) / seconds:.1f} a second were shown beside the simulation")
    print(f"{1e3 * used / max(read, 1):.1f} ms of processor time for each that was read")


if __name__ == "__main__":
    main()
