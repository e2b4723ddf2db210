"""Sentences on the drift of the band model's bands away from those of the simulation."""

from occ_gui.simulation.snapshot import ColumnView
from occ_model.scene.light_words import has_chips
from occ_model.scene.parameters import PARAMETERS

_FIELD = PARAMETERS["band_reading"].label
_MIN_VISIBLE_DRIFT = 0.05  # columns per packet


def describe_drift(reading: ColumnView) -> str:
    """State by how much the band model drifts; empty if it does not."""
    columns = abs(reading.band_drift)
    if columns < _MIN_VISIBLE_DRIFT:
        return ""
    sent = reading.scene.transmitter
    unit = "period"
    if _has_chips(reading):
        unit = "cycle" if sent.pattern else "packet"
    return f"drifts {columns:.{0 if columns >= 10.0 else 1}f} columns a {unit}"


def drift_sentence(reading: ColumnView) -> str:
    """State the drift and its reason in a line; empty if there is none."""
    if not (drift := describe_drift(reading)):
        return ""
    skips = ", and skips the exposure between equal chips" if _has_chips(reading) else ""
    return f"The band model {drift}: it rounds{skips}."


def explain_comparison() -> str:
    """Describe how to compare the band model with the simulation if it does not drift."""
    return (
        "The band model is drawn with exact run lengths, so that its bands coincide with those of "
        "the simulation: compare their width and levels. "
        f"Read literally, in whole columns, it drifts: see the field “{_FIELD}” under Model."
    )


def explain_drift(reading: ColumnView) -> str:
    """Explain the drift, and how to avoid it."""
    errors = "to whole columns. These errors"
    if _has_chips(reading):
        errors = (
            "to whole columns, and leaves out the exposure between two equal chips. Both errors"
        )
    return (
        f"The band model rounds each band {errors} add up along the picture, so that its bands "
        f"drift away from those of the simulation. The field “{_FIELD}” under Model can select "
        "exact run lengths, with which width and levels of the bands can be compared."
    )


def _has_chips(reading: ColumnView) -> bool:
    return has_chips(reading.scene.transmitter)
