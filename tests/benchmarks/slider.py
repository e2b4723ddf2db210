"""From a slider's move to what is painted, offscreen, at full resolution.

``python tests/benchmarks/slider.py`` moves the exposure again and again, each time when all is
shown that the last move called for, and prints for each kind of result the median and the 95th
percentile of the time from the change to the end of the paint that shows it. Then it drags for
three seconds, with a move every 16 ms, and prints how many pictures a second were painted, and when
the exact picture followed the last move.
"""

import argparse
import math
import os
import subprocess
import sys
from dataclasses import dataclass, field
from time import perf_counter

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QEventLoop, QObject, Qt, QTimer

import occ_model as occ
from occ_gui.app.command_line import start
from occ_gui.core.workspace import Workspace
from occ_gui.simulation.snapshot import Picture, Reading
from occ_model.scene.scene import Scene, SimulationSettings

_WARM_UP = 5
_DRAG_SECONDS = 3.0
_MOVE_SECONDS = 0.016
_SIZES = ((1280, 800), (1920, 1080))
_NAMES = ("picture or its draft", "profile and verdict", "exact panel", "exact picture")

CASES = {
    "noise-free": ("phone-136us", SimulationSettings(tolerance=math.inf)),
    "phone-136us": ("phone-136us", SimulationSettings()),
    "phone-136us-real": ("phone-136us-real", SimulationSettings()),
    "tablet-122us-real": ("tablet-122us-real", SimulationSettings()),
}
"""The preset of each case, and how it is simulated."""

_ALWAYS = QEventLoop.ProcessEventsFlag.WaitForMoreEvents


@dataclass
class Painted:
    """When the results of each scene were painted, by the kind of result."""

    times: dict[str, list[tuple[float, Scene]]] = field(default_factory=dict)

    def add(self, kind: str, scene: Scene) -> None:
        """Note that a result is on the screen now."""
        self.times.setdefault(kind, []).append((perf_counter(), scene))

    def first(self, scene: Scene, *kinds: str) -> float:
        """Say when a result of one of these kinds was painted for a scene; infinity for never."""
        found = [at for kind in kinds for at, of in self.times.get(kind, ()) if of == scene]
        return min(found, default=math.inf)


class Window(QObject):
    """An application whose results are noted once they are painted."""

    def __init__(self, case: str, size: tuple[int, int]) -> None:
        super().__init__()
        preset, settings = CASES[case]
        # As the program starts: its time slices of threads, and when it collects garbage.
        self._qt, self.application = start(
            Workspace(occ.load_preset(preset), settings), sys.argv[:1]
        )
        self.painted = Painted()
        self._waiting: list[tuple[str, Scene]] = []
        self.application.simulation.picture_ready.connect(self._on_picture)
        self.application.simulation.reading_shown.connect(self._on_reading)
        self.application.window.resize(*size)
        self.application.window.show()
        self.come_to_rest()

    def _on_picture(self, picture: Picture) -> None:
        kind = "exact" if picture.view_as("camera").is_whole else "panel"
        kind = "draft" if picture.frame.rows_step > 1 else kind
        self._waiting.append((kind, picture.frame.scene))

    def _on_reading(self, reading: Reading) -> None:
        self._waiting.append(("verdict", reading.scene))

    def paint(self, flags: QEventLoop.ProcessEventsFlag = _ALWAYS) -> None:
        """Handle events, and note what they have painted."""
        self._qt.processEvents(flags)
        if self._waiting:
            waiting, self._waiting = self._waiting, []
            self._qt.processEvents()  # the paint that these have asked for
            for kind, scene in waiting:
                self.painted.add(kind, scene)

    def come_to_rest(self) -> None:
        """Handle events until all results are shown."""
        while not self.application.is_idle or self._waiting:
            self.paint()
        self._qt.processEvents()

    def single_moves(self, moves: int) -> list[tuple[float, ...]]:
        """Move and wait; give the seconds until each of ``_NAMES`` is painted."""
        rows = []
        for move in range(moves + _WARM_UP):
            start = perf_counter()
            self.application.scene_store.change(1, exposure_time=60e-6 + 1e-7 * move)
            scene = self.application.scene_store.scene
            self.come_to_rest()
            first = self.painted.first
            kinds = (("draft", "exact"), ("verdict",), ("panel", "exact"), ("exact",))
            rows.append(tuple(first(scene, *names) - start for names in kinds))
        return rows[_WARM_UP:]

    def drag(self) -> tuple[float, float]:
        """Drag; give the pictures painted a second, and the seconds from the end to the exact."""
        moves = round(_DRAG_SECONDS / _MOVE_SECONDS)
        made: list[float] = []
        loop = QTimer(timerType=Qt.TimerType.PreciseTimer)

        def move() -> None:
            made.append(perf_counter())
            self.application.scene_store.change(2, exposure_time=80e-6 + 1e-7 * len(made))
            if len(made) == moves:
                loop.stop()

        loop.timeout.connect(move)
        loop.start(round(1e3 * _MOVE_SECONDS))
        while len(made) < moves:
            self.paint()
        times = [at for kind in ("draft", "exact") for at, _ in self.painted.times.get(kind, ())]
        during = sum(made[0] <= at <= made[-1] for at in times)
        self.come_to_rest()
        exact = self.painted.first(self.application.scene_store.scene, "exact")
        return during / (made[-1] - made[0]), exact - made[-1]

    def close(self) -> None:
        self.application.window.close()
        self.application.stop()


def _measure(case: str, size: tuple[int, int], moves: int) -> None:
    window = Window(case, size)
    ms = 1e3 * np.array(window.single_moves(moves))
    rate, exact = window.drag()
    window.close()
    print(f"{case}, {size[0]} x {size[1]}:")
    for name, values in zip(_NAMES, ms.T, strict=True):
        median, late = np.percentile(values, (50, 95))
        print(f"  {name:22s} median {median:6.1f} ms, 95th percentile {late:6.1f} ms")
    print(f"  a drag of {_DRAG_SECONDS:g} s: {rate:.1f} pictures a second painted, the exact one")
    print(f"    {1e3 * exact:.0f} ms after the last move")


def _size(text: str) -> tuple[int, int]:
    width, height = map(int, text.split("x"))
    return width, height


def main() -> None:
    """Print the table, each case measured in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--case", action="append", choices=tuple(CASES), help="default: all")
    parser.add_argument("--size", action="append", type=_size, metavar="WIDTHxHEIGHT")
    parser.add_argument("--moves", type=int, default=60)
    options = parser.parse_args()
    chosen = [(case, size) for case in options.case or CASES for size in options.size or _SIZES]
    if len(chosen) == 1:
        _measure(*chosen[0], options.moves)
        return
    for case, (width, height) in chosen:
        arguments = [f"--case={case}", f"--size={width}x{height}", f"--moves={options.moves}"]
        subprocess.run([sys.executable, __file__, *arguments], check=True)


if __name__ == "__main__":
    main()
