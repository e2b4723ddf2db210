"""How long the window keeps events waiting while the map and the accuracy study are at work.

``python tests/benchmarks/stall.py`` shows the panes of both beside each other on an offscreen
window, drags the exposure slider for half a second every few seconds, so that both begin anew again
and again, and prints how late events were handled: with neither pane seen, with one, and with both.
"""

import argparse
import os
from dataclasses import dataclass, field
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING

from live_map import Beat

if TYPE_CHECKING:
    from occ_gui.app.application import Application

# Qt not at the top, either: worker processes import this file, too, and need no window.

_MOVE_MS = 16
_DRAG_S, _CYCLE_S = 0.5, 5.0
_SEEN = (
    ("neither", False, False),
    ("the map", True, False),
    ("the accuracy study", False, True),
    ("both", True, True),
)


@dataclass
class _Found:
    """How the window responded, and what was at work meanwhile, seen every few milliseconds."""

    beat: Beat = field(default_factory=Beat)
    mapping: list[bool] = field(default_factory=list)
    studying: list[bool] = field(default_factory=list)

    def fractions(self) -> tuple[float, float, float]:
        """Give the percentages of the time: of the map, of the study, and of both at once."""
        both = [a and b for a, b in zip(self.mapping, self.studying, strict=True)]
        one, other, two = (100 * sum(v) / len(v) for v in (self.mapping, self.studying, both))
        return one, other, two


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--preset", default="phone-136us")
    parser.add_argument("--seconds", type=float, default=30.0, help="for each line of the table")
    options = parser.parse_args()
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    import occ_model as occ
    from occ_gui.app.command_line import start, wait_until_shown
    from occ_gui.core.workspace import Workspace

    _, application = start(Workspace(occ.load_preset(options.preset)), ["stall"])
    application.window.resize(1600, 1000)
    application.window.show()
    wait_until_shown(application, measured=True)
    print(f"{options.preset}, waiting in ms; the 95th percentile of ticks should be under 30:")
    print(f"  {'at work':20s}  median   95 %  worst | any event, 95 % | map, study, both at work")
    for title, with_map, with_study in _SEEN:
        _show_panes(application, with_map, with_study)
        found = _watch(application, options.seconds)
        beat, fractions = (
            found.beat,
            "".join(f"{fraction:5.0f} %" for fraction in found.fractions()),
        )
        print(
            f"  {title:20s}{median(beat.late):8.1f}{beat.percentile(0.95):7.1f}"
            f"{max(beat.late):7.1f} |{beat.waiting(0.95):16.1f} | {fractions}"
        )
    application.window.close()


def _show_panes(application: "Application", with_map: bool, with_study: bool) -> None:
    """Put the map beside the panes that it shares its place with, and show what is wanted."""
    from PySide6.QtCore import Qt

    window, docks = application.window, application.window.docks
    window.addDockWidget(
        Qt.DockWidgetArea.BottomDockWidgetArea, docks["map"], Qt.Orientation.Horizontal
    )
    docks["map"].setVisible(with_map)
    docks["accuracy"].setVisible(with_study)
    docks["profile"].setVisible(not with_study)


def _watch(application: "Application", seconds: float) -> _Found:
    """Drag now and then for so many seconds, and note how the window responds."""
    from PySide6.QtCore import QEventLoop, Qt, QTimer

    slider = application.controls.main_rows()["exposure_time"].slider
    found, loop = _Found(), QEventLoop()
    hand = QTimer(timerType=Qt.TimerType.PreciseTimer)
    start = perf_counter()

    def move() -> None:
        found.mapping.append(not application.shell.pane("map").map.channel.is_idle)
        found.studying.append(not application.shell.pane("accuracy").study.runner.is_idle)
        past = perf_counter() - start
        cycle, place = divmod(past, _CYCLE_S)
        held = place < _DRAG_S
        slider.setSliderDown(held)
        if held:
            # To and fro, so that no drag ends where the one before it ended.
            slider.setValue(200 + 10 * int(cycle % 7) + round(500 * place))
        if past > seconds:
            loop.quit()

    hand.timeout.connect(move)
    found.beat.start()
    hand.start(_MOVE_MS)
    loop.exec()
    found.beat.stop()
    hand.stop()
    slider.setSliderDown(False)
    return found


if __name__ == "__main__":
    main()
