"""Format a measured readout time for other programs: OpenDroneMap and Gyroflow.

Both need the time of the whole frame in milliseconds: a line's readout time times the lines.

OpenDroneMap has the options ``--rolling-shutter`` and ``--rolling-shutter-readout``
(https://docs.opendronemap.org/arguments/rolling-shutter-readout/).

Gyroflow has the fields ``frame_readout_time`` and ``frame_readout_direction`` in its lens profiles
(``src/core/lens_profile.rs``) and in the header of its text format for motion data, GCSV
(https://docs.gyroflow.xyz/app/technical-details/gcsv-format). The direction is ``TopToBottom``,
``BottomToTop``, ``LeftToRight`` or ``RightToLeft``. Stripes show along which axis the sensor is
read out, but not from which end; most sensors are read from the top.
"""

import math
from collections.abc import Mapping

from occ_model.results.match import Match
from occ_model.results.photo_table import SURE, PhotoRow, PhotoTable

_DIRECTIONS = {"lines": "TopToBottom", "columns": "LeftToRight"}
"""Gyroflow's name of the usual direction, by the scanned axis of the upright picture."""

DIRECTION_NOTE = (
    "The direction in Gyroflow's line is assumed, as most cameras have it: stripes show the axis "
    "of the readout, not from which end it begins."
)

_MILLISECOND = 1e-3

_MOST_SCATTER = 0.01  # maximum relative error of a mean of photos that differ by more than theirs


def frame_readout_time(table: PhotoTable) -> tuple[float, float] | None:
    """Return the readout time of the whole frame and its standard deviation in seconds.

    None if it was not measured, or the photos differ in their numbers of lines. The photos must not
    have been cropped or resized, which changes the lines.
    """
    rows = _rows_in_mean(table)
    line_counts = {row.lines for row in rows}
    if table.estimate != "readout_time" or table.estimated is None or len(line_counts) != 1:
        return None
    (count,) = line_counts
    return table.estimated.value * count, table.estimated.uncertainty * count


def lines_to_paste(table: PhotoTable) -> dict[str, str]:
    """Return a line for each program, by name; none if there is no readout time or no agreement."""
    frame = frame_readout_time(table)
    if frame is None or table.estimated is None:
        return {}
    if not table.estimated.agrees and frame[1] > _MOST_SCATTER * frame[0]:
        return {}
    axes = {row.scanned_along for row in _rows_in_mean(table)}
    return lines_of_frame(*frame, axes.pop() if len(axes) == 1 else "")


def lines_of_match(match: Match, *, turned: bool) -> dict[str, str]:
    """Return the lines of one match for other programs; none if it is doubtful.

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
    number = _milliseconds(seconds, deviation)
    lines = {"OpenDroneMap": f"--rolling-shutter --rolling-shutter-readout {number}"}
    if scanned_along:
        direction = _DIRECTIONS[scanned_along]
        lines["Gyroflow"] = (
            f'"frame_readout_time": {number}, "frame_readout_direction": "{direction}"'
        )
    return lines


def note_on(lines: Mapping[str, str]) -> str:
    """State what lines for other programs assume without measuring it; empty if nothing."""
    return DIRECTION_NOTE if "Gyroflow" in lines else ""


def format_lines(table: PhotoTable, condition: str) -> list[str]:
    """Format a table's lines to paste, each after its program's name and the condition."""
    lines = lines_to_paste(table)
    texts = [f"{program}: {condition}{line}" for program, line in lines.items()]
    return [text for text in (*texts, note_on(lines)) if text]


def _rows_in_mean(table: PhotoTable) -> list[PhotoRow]:
    return [row for place, row in enumerate(table.rows) if table.is_counted(place)]


def _milliseconds(seconds: float, deviation: float) -> str:
    """Format a time to the second digit of its standard deviation, at least to a microsecond."""
    digits = 3
    if deviation > 0.0:
        digits = max(digits, 1 - math.floor(math.log10(deviation / _MILLISECOND)))
    return f"{seconds / _MILLISECOND:.{min(digits, 9)}f}"
