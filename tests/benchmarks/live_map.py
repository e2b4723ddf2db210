"""How soon the detection map answers, and how the window responds meanwhile.

``python tests/benchmarks/live_map.py`` drags the exposure slider on an offscreen window for a
second, with the map in front, and prints what it took from the last change to the first map that is
painted and to the full one, and how late events were handled from the start of the drag until then.
"""

import argparse
import os
from math import inf
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from occ_gui.app.application import Application
    from occ_gui.detection_map.rate_map import RateMap

# Qt not at the top, either: worker processes import this file, too, and need no window.

_CHANGES, _SECONDS = 60, 1.0
_BEAT_MS = 2
_PATIENCE_S = 30.0
_COARSE_POINTS = 5 * 3


class Beat:
    """Ticks on the window's thread, and notes how late each tick comes."""

    def __init__(self) -> None:
        from PySide6.QtCore import Qt, QTimer

        self.late: list[float] = []
        """Milliseconds, one a tick."""
        self._last = 0.0
        self._timer = QTimer(timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._tick)

    def _tick(self) -> None:
        now = perf_counter()
        self.late.append(1e3 * (now - self._last) - _BEAT_MS)
        self._last = now

    def start(self) -> None:
        self._last = perf_counter()
        self._timer.start(_BEAT_MS)

    def stop(self) -> None:
        self._timer.stop()

    def percentile(self, fraction: float) -> float:
        """Say what this fraction of the ticks was not later than, in milliseconds."""
        return sorted(self.late)[int(fraction * len(self.late))]


class _PaintedMaps:
    """Paints every map at once, and notes when: the time, whether coarse, and whether full."""

    def __init__(self, application: "Application") -> None:
        self.times: list[tuple[float, bool, bool]] = []
        self._controller, self._pane = (
            application.shell.pane("map").map,
            application.shell.pane("map").view.plots,
        )
        self._show_map = self._pane.show_map
        self._pane.show_map = self._show

    def _show(self, rates: "RateMap") -> None:
        self._show_map(rates)
        for plot in self._pane.plots:
            plot.repaint()
        coarse = self._controller.is_current and rates.known_count >= _COARSE_POINTS
        full = self._controller.is_current and rates.least_images > 0
        self.times.append((perf_counter(), coarse, full))

    def end(self) -> None:
        """Let the maps be painted as they are otherwise."""
        self._pane.show_map = self._show_map


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--preset", default="phone-136us")
    parser.add_argument("--dock", default="map", help="the pane in front; another one: no map")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    import occ_model as occ
    from occ_gui.app.command_line import start
    from occ_gui.app.screenshot import wait_until_shown
    from occ_gui.core.workspace import Workspace

    _, application = start(Workspace(occ.load_preset(options.preset)), ["live_map"])
    application.window.show()
    application.window.bring_to_front(options.dock)
    wait_until_shown(application, measured=True)
    rounds = [_round(application, number) for number in range(options.rounds)]
    application.window.close()
    print(f"{options.preset}, medians (worst) of {options.rounds} drags:")
    for title, place, wanted in (
        ("first map painted", 0, "< 100 ms"),
        ("full map painted", 1, "< 1000 ms"),
        ("response, median", 2, ""),
        ("response, 95th percentile", 3, "< 30 ms"),
        ("response, maximum", 4, ""),
        ("maps painted during the drag", 5, ""),
    ):
        values = [found[place] for found in rounds]
        worst = min(values) if place == 5 else max(values)
        print(f"  {title:32s}{median(values):8.1f} ({worst:.1f})   {wanted}")


def _round(application: "Application", number: int) -> tuple[float, ...]:
    """Drag once; give all that is measured, times in milliseconds."""
    from PySide6.QtCore import QEventLoop, Qt, QTimer

    controller = application.shell.pane("map").map
    slider = application.controls.main_rows()["exposure_time"].slider
    beat, maps = Beat(), _PaintedMaps(application)
    loop, ticker = QEventLoop(), QTimer(timerType=Qt.TimerType.PreciseTimer)
    changes: list[float] = []

    def change() -> None:
        done = len(changes)
        if done == _CHANGES:
            patience = _PATIENCE_S if controller.map else 1.0
            if controller.complete is not None or perf_counter() > changes[-1] + patience:
                loop.quit()
            return
        slider.setValue(200 + 10 * (done if number % 2 == 0 else _CHANGES - done))
        changes.append(perf_counter())

    ticker.timeout.connect(change)
    slider.setSliderDown(True)
    beat.start()
    ticker.start(round(1e3 * _SECONDS / _CHANGES))
    loop.exec()
    beat.stop()
    ticker.stop()
    slider.setSliderDown(False)
    maps.end()
    stop = changes[-1]
    first = next((at for at, coarse, _ in maps.times if coarse and at >= stop), inf)
    full = next((at for at, _, is_full in maps.times if is_full and at >= stop), inf)
    during = sum(at < stop for at, *_ in maps.times)
    times = (1e3 * (first - stop), 1e3 * (full - stop))
    return (*times, median(beat.late), beat.percentile(0.95), max(beat.late), during)


if __name__ == "__main__":
    main()
