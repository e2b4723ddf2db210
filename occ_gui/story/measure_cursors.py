"""Measuring cursors: two columns between which columns, time and levels are measured."""

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND

NAMES = ("1", "2")  # a and B are pins
_START = (0.3, 0.6)  # where the cursors stand at first, as parts of what is in view


class MeasureCursors(QObject):
    """Two columns that the user moves, or none while nothing is measured."""

    changed = Signal()  # a cursor has moved, or they have been switched on or off

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.columns: list[float] = []  # the columns of A and B; empty while nothing is measured

    def switch(self, on: bool, first: float, last: float) -> None:
        self.columns = [first + part * (last - first) for part in _START] if on else []
        self.changed.emit()

    def move(self, place: int, column: float, columns: int) -> None:
        if self.columns:
            self.columns[place] = min(max(column, 0.0), columns - 1.0)
            self.changed.emit()

    def near(self, column: float, reach: float) -> int | None:
        found = [(abs(each - column), place) for place, each in enumerate(self.columns)]
        within = [pair for pair in found if pair[0] <= reach]
        return min(within)[1] if within else None


@dataclass(frozen=True, slots=True)
class Measured:
    columns: float  # from the first to the second, negative where the second is at the left
    time: float  # the same in seconds
    # How much higher the profile is at the second, in grey levels; None outside of it
    levels: float | None
    chips: float  # the same time in chips


def measure(cursors: MeasureCursors, scene: Scene, profile: FloatArray | None) -> Measured | None:
    if not cursors.columns:
        return None
    first, second = cursors.columns
    columns = second - first
    time = columns * scene.camera.readout_time
    places = [round(first), round(second)]
    levels = None
    if profile is not None and all(0 <= place < len(profile) for place in places):
        levels = float(profile[places[1]] - profile[places[0]])
    return Measured(columns, time, levels, time * scene.transmitter.switching_frequency)


def in_words(measured: Measured) -> str:
    parts = [
        f"1 to 2: {measured.columns:.1f} columns",
        SECOND.format(measured.time, 4),
    ]
    if measured.levels is not None:
        parts.append(f"{measured.levels:+.1f} levels")
    parts.append(f"{measured.chips:.2f} chips")
    if measured.time:
        parts.append(f"as a period {HERTZ.format(1 / abs(measured.time), 4)}")
    return "  ·  ".join(parts)
