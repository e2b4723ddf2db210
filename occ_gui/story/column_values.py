"""Values of one column, and the differences between two columns."""

from dataclasses import dataclass

from occ_gui.simulation.snapshot import ColumnView
from occ_gui.story.code_row import CodeRow
from occ_gui.story.column_axis import MeasureCursors
from occ_gui.story.light_row import LightRow
from occ_gui.story.profile_row import ProfileRow
from occ_gui.widgets.state_look import State
from occ_model.arrays import FloatArray
from occ_model.scene.light_words import blinking_lamp, has_chips
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND

VALUE_SEPARATOR = "  ·  "

_MICRO = 1e6
_MOST_CHIPS = 20_000  # most chips in an exposure whose light is averaged while the mouse moves


@dataclass(frozen=True, slots=True)
class ColumnValues:
    column: int
    time: float  # the start of its exposure in seconds
    light: float  # the light at that time, 0 to 1
    # The mean light during its exposure; None if there are too many chips to average
    mean_light: float | None
    level: float
    chip: int | None = None
    bit: int | None = None
    value: int | None = None
    state: State = State.NEUTRAL


def read_values(
    column: int, scene: Scene, light: LightRow, profile: ProfileRow, code: CodeRow
) -> ColumnValues | None:
    """Read all rows at a column; None without results or outside the picture."""
    levels = profile.levels
    if levels is None or not 0 <= column < len(levels):
        return None
    exposure_columns = scene.camera.exposure_time / scene.camera.readout_time
    start = light.find_light(column, column + min(exposure_columns, 1.0), _MOST_CHIPS)
    curve = light.find_light(column, column + exposure_columns, _MOST_CHIPS)
    chip, bit = code.find_chip_and_bit(column)
    return ColumnValues(
        column=column,
        time=scene.model.start_time + column * scene.camera.readout_time,
        light=0.0 if start is None else start.light_at(column),
        mean_light=None if curve is None else curve.mean(column, column + exposure_columns),
        level=float(levels[column]),
        chip=chip,
        bit=bit,
        value=None if bit is None else code.value_of(bit),
        state=State.NEUTRAL if bit is None else code.state_of(bit),
    )


def describe_values(values: ColumnValues, scene: Scene) -> str:
    parts = [
        f"column {values.column}",
        f"{values.time * _MICRO:.1f} µs",
        _describe_light(values.light),
    ]
    if values.mean_light is not None:
        exposure = scene.camera.exposure_time
        exposure_text = SECOND.format(exposure, 4)
        lamp = blinking_lamp(scene.transmitter)
        if has_chips(scene.transmitter) or (lamp is not None and lamp.depth == 1.0):
            parts.append(
                f"lit for {SECOND.format(values.mean_light * exposure, 3)} of {exposure_text}"
            )
        else:
            parts.append(f"mean of {exposure_text} {100.0 * values.mean_light:.0f} %")
    parts.append(f"level {values.level:.1f}")
    if values.chip is not None:
        parts.append(f"chip {values.chip}")
    if values.bit is not None and values.value is not None:
        mark = {State.GOOD: "right", State.BAD: "wrong"}.get(values.state, "")
        parts.append(f"bit {values.bit + 1}: {values.value} {mark}".rstrip())
    return VALUE_SEPARATOR.join(parts)


def _describe_light(light: float) -> str:
    if light in (0.0, 1.0):
        return "light on" if light else "light off"
    return f"light {100.0 * light:.0f} %"


@dataclass(frozen=True, slots=True)
class CursorDifference:
    columns: float  # from the first to the second; negative if the second is at the left
    time: float  # the same in seconds
    # Rise of the profile from the first to the second, in grey levels; None outside the profile
    levels: float | None
    count: float  # the same time in chips, or in periods of a light without chips
    unit: str


def measure(
    cursors: MeasureCursors, reading: ColumnView, profile: FloatArray | None
) -> CursorDifference | None:
    if not cursors.columns:
        return None
    first, second = cursors.columns
    columns = second - first
    sent = reading.scene.transmitter
    time = columns * reading.scene.camera.readout_time
    nearest = [round(first), round(second)]
    levels = None
    if profile is not None and all(0 <= index < len(profile) for index in nearest):
        levels = float(profile[nearest[1]] - profile[nearest[0]])
    count, unit = columns / reading.period_columns, "periods"
    if has_chips(sent):
        count, unit = time * sent.switching_frequency, "chips"
    return CursorDifference(columns, time, levels, count, unit)


def describe_difference(difference: CursorDifference) -> str:
    parts = [f"1 to 2: {difference.columns:.1f} columns", SECOND.format(difference.time, 4)]
    if difference.levels is not None:
        parts.append(f"{difference.levels:+.1f} levels")
    parts.append(f"{difference.count:.2f} {difference.unit}")
    if difference.time:
        parts.append(f"as a period {HERTZ.format(1 / abs(difference.time), 4)}")
    return VALUE_SEPARATOR.join(parts)
