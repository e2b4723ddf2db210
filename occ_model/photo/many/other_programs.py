"""A measured readout time as other programs take it: OpenDroneMap and Gyroflow.

Both take the time of the whole frame in milliseconds: the readout time of a line times the lines.

OpenDroneMap has the options ``--rolling-shutter`` and ``--rolling-shutter-readout``
(https://docs.opendronemap.org/arguments/rolling-shutter-readout/).

Gyroflow has the fields ``frame_readout_time`` and ``frame_readout_direction`` in its lens profiles
(``src/core/lens_profile.rs``), as has the head of its text format for motion data, GCSV
(https://docs.gyroflow.xyz/app/technical-details/gcsv-format). A profile names the direction
``TopToBottom``, ``BottomToTop``, ``LeftToRight`` or ``RightToLeft``. Stripes show along which axis
the sensor is read out, but not from which end; most are read from the top.
"""

import math
from collections.abc import Mapping

from occ_model.results.match import Match
from occ_model.results.photo_table import SURE, PhotoRow, PhotoTable

_DIRECTIONS = {"lines": "TopToBottom", "columns": "LeftToRight"}
"""Gyroflow's usual direction by the axis of the upright picture that is scanned."""

DIRECTION_NOTE = (
    "The direction in Gyroflow's line is assumed, as most cameras have it: stripes show the axis "
    "of the readout, not from which end it begins."
)

_MILLISECOND = 1e-3

_MOST_SCATTER = 0.01  # maximum relative error of the mean of photos that scatter more


def frame_readout_time(table: PhotoTable) -> tuple[float, float] | None:
    """Return the readout time of the whole frame and its standard deviation in seconds.

    None where it was not measured, or the photos differ in their numbers of lines. They must be as
    the camera stored them: one that was cut or made smaller has other lines.
    """
    counted = _counted(table)
    lines = {row.lines for row in counted}
    if table.estimate != "readout_time" or table.estimated is None or len(lines) != 1:
        return None
    (count,) = lines
    return table.estimated.value * count, table.estimated.uncertainty * count


def lines_to_paste(table: PhotoTable) -> dict[str, str]:
    """Return a line for each program, by name; none without a readout time or agreement."""
    frame = frame_readout_time(table)
    if frame is None or table.estimated is None:
        return {}
    if not table.estimated.agrees and frame[1] > _MOST_SCATTER * frame[0]:
        return {}
    axes = {row.scanned_along for row in _counted(table)}
    return lines_of_frame(*frame, axes.pop() if len(axes) == 1 else "")


def lines_of_match(match: Match, *, turned: bool) -> dict[str, str]:
    """Return the lines of one match for other programs; none where it is doubtful.

    ``turned``: whether the photo's columns are the file's lines.
    """
    frame = frame_of_match(match)
    if frame is None or match.verdict != SURE:
        return {}
    return lines_of_frame(*frame, "lines" if turned else "columns")


def frame_of_match(match: Match) -> tuple[float, float] | None:
    """Return the readout time of one photo's whole frame and its standard deviation in seconds."""
    deviation = match.uncertainties.get("readout_time")
    if deviation is None:
        return None
    lines = match.scene.camera.columns
    return match.readout_time * lines, deviation * lines


def lines_of_frame(seconds: float, deviation: float, scanned_along: str) -> dict[str, str]:
    """Return a line for each program, by name, from a frame's readout time in seconds.

    ``scanned_along``: ``"lines"`` or ``"columns"`` of the upright picture; else no line.
    """
    written = _milliseconds(seconds, deviation)
    lines = {"OpenDroneMap": f"--rolling-shutter --rolling-shutter-readout {written}"}
    if scanned_along:
        direction = _DIRECTIONS[scanned_along]
        lines["Gyroflow"] = (
            f'"frame_readout_time": {written}, "frame_readout_direction": "{direction}"'
        )
    return lines


def note_on(lines: Mapping[str, str]) -> str:
    """State what lines for other programs assume without a measurement; empty for no lines."""
    return DIRECTION_NOTE if "Gyroflow" in lines else ""


def stated_lines(table: PhotoTable, condition: str) -> list[str]:
    """Format a table's lines to paste, after their programs' names, with their condition."""
    lines = lines_to_paste(table)
    written = [f"{program}: {condition}{line}" for program, line in lines.items()]
    return [text for text in (*written, note_on(lines)) if text]


def _counted(table: PhotoTable) -> list[PhotoRow]:
    return [row for place, row in enumerate(table.rows) if table.is_counted(place)]


def _milliseconds(seconds: float, deviation: float) -> str:
    """Write a time to the second digit of its standard deviation, at least to a microsecond."""
    digits = 3
    if deviation > 0.0:
        digits = max(digits, 1 - math.floor(math.log10(deviation / _MILLISECOND)))
    return f"{seconds / _MILLISECOND:.{min(digits, 9)}f}"
