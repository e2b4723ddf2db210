"""From a slider's move to the painted frame, offscreen, at full phone resolution.

``python tests/benchmarks/slider.py`` prints the median and the 95th percentile of the time from a
change of the exposure to the end of the paint that shows it, without noise and with it.
"""

import math
import os
import sys
from time import perf_counter

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
from PySide6.QtCore import QEventLoop, QObject
from PySide6.QtWidgets import QApplication

import occ_model as occ
from occ_gui.app.application import Application
from occ_model.scene.simulation_settings import SimulationSettings

_MOVES = 150
_WARM_UP = 20


class _Painted(QObject):
    """Notes when the picture of a scene has been given to its pane."""

    def __init__(self, application: Application) -> None:
        super().__init__()
        self.shown = False
        # The picture comes first, what was read from it a little later.
        application.simulation.picture_ready.connect(self._note)

    def _note(self) -> None:
        self.shown = True


def frame_times(settings: SimulationSettings, size: tuple[int, int]) -> list[float]:
    """Move the exposure again and again; give the seconds until each change is on the screen."""
    qt = QApplication.instance() or QApplication(sys.argv[:1])
    assert isinstance(qt, QApplication)
    application = Application(occ.load_preset("phone-136us"), settings)
    application.window.resize(*size)
    application.window.show()
    painted = _Painted(application)
    _until_painted(qt, painted)
    times = []
    for move in range(_MOVES + _WARM_UP):
        painted.shown = False
        start = perf_counter()
        exposure = 60e-6 + 1e-7 * move
        application.store.change(1, exposure_time=exposure)
        _until_painted(qt, painted)
        times.append(perf_counter() - start)
        while not application.is_idle:  # a hand moves no faster than what it moves is read
            qt.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        qt.processEvents()
    application.window.close()
    return times[_WARM_UP:]


def _until_painted(qt: QApplication, painted: _Painted) -> None:
    while not painted.shown:
        qt.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
    # What the snapshot changed is painted by the events that wait now.
    qt.processEvents()


def main() -> None:
    """Print the table."""
    for name, settings in {
        "noise-free": SimulationSettings(tolerance=math.inf),
        "noise from a reused plane": SimulationSettings(noise="reused"),
    }.items():
        for size in ((1280, 800), (1920, 1080)):
            ms = 1e3 * np.array(frame_times(settings, size))
            print(
                f"{name}, {size[0]} x {size[1]}: median {np.median(ms):.1f} ms, "
                f"95th percentile {np.percentile(ms, 95):.1f} ms"
            )


if __name__ == "__main__":
    main()
