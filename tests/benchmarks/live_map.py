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

_CHANGES, _SECONDS = 60, 1.0
_BEAT_MS = 2
_PATIENCE_S = 30.0
_COARSE_POINTS = 5 * 3


def main() -> None:
    """Measure, several times."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--preset", default="phone-136us")
    parser.add_argument("--dock", default="map", help="the pane in front; another one: no map")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    # Not at the top: worker processes import this file, too, and need no window.
    import occ_model as occ
    from occ_gui.app import start, wait_until_shown

    _, application = start(occ.load_preset(options.preset), ["live_map"])
    application.window.show()
    application.window.docks[options.dock].raise_()
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


def _round(application, number):
    """Drag once; give all that is measured, times in milliseconds."""
    from PySide6.QtCore import QEventLoop, Qt, QTimer

    reach = application.reach.map
    slider = application.controls.main_rows()["exposure_time"].slider
    late, painted = [], []
    beat = QTimer(timerType=Qt.TimerType.PreciseTimer)
    last = [perf_counter()]

    def count_late():
        now = perf_counter()
        late.append(1e3 * (now - last[0]) - _BEAT_MS)
        last[0] = now

    beat.timeout.connect(count_late)
    pane = application.detection.plots
    show_map = pane.show_map

    def paint_now(rates):
        show_map(rates)
        for plot in pane.plots:
            plot.repaint()
        coarse = reach.is_current and rates.known >= _COARSE_POINTS
        painted.append((perf_counter(), coarse, reach.is_full))

    pane.show_map = paint_now
    loop, stop = QEventLoop(), [inf]
    ticker = QTimer(timerType=Qt.TimerType.PreciseTimer)

    def change():
        done = len(changes)
        if done == _CHANGES:
            if reach.is_full or perf_counter() > stop[0] + (1.0 if not reach.map else _PATIENCE_S):
                loop.quit()
            return
        slider.setValue(200 + 10 * (done if number % 2 == 0 else _CHANGES - done))
        changes.append(perf_counter())
        if done == _CHANGES - 1:
            stop[0] = perf_counter()

    changes = []
    ticker.timeout.connect(change)
    slider.setSliderDown(True)
    last[0] = perf_counter()
    beat.start(_BEAT_MS)
    ticker.start(round(1e3 * _SECONDS / _CHANGES))
    loop.exec()
    for timer in (beat, ticker):
        timer.stop()
    slider.setSliderDown(False)
    pane.show_map = show_map
    late.sort()
    first = next((at for at, coarse, _ in painted if coarse and at >= stop[0]), inf)
    full = next((at for at, _, is_full in painted if is_full and at >= stop[0]), inf)
    during = sum(at < stop[0] for at, *_ in painted)
    times = (1e3 * (first - stop[0]), 1e3 * (full - stop[0]))
    return (*times, median(late), late[int(0.95 * len(late))], late[-1], during)


if __name__ == "__main__":
    main()
