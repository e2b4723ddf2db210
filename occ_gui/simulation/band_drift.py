"""Words for the band model's drift: its bands run off those of the simulation."""

from occ_gui.simulation.snapshot import ColumnView
from occ_model.scene.parameters import PARAMETERS

_FIELD = PARAMETERS["band_reading"].label
_MIN_VISIBLE_DRIFT = 0.05  # drift in columns per packet below which it is not seen


def drift_of(reading: ColumnView) -> str:
    """State by how much the band model drifts; empty where it does not."""
    columns = abs(reading.band_drift)
    if columns < _MIN_VISIBLE_DRIFT:
        return ""
    period = "cycle" if reading.scene.transmitter.pattern else "packet"
    return f"drifts {columns:.{0 if columns >= 10.0 else 1}f} columns a {period}"


def drift_sentence(reading: ColumnView) -> str:
    """State the drift with its reason in a line; empty where there is none."""
    if not (drift := drift_of(reading)):
        return ""
    return f"The band model {drift}: it rounds, and skips the exposure between equal chips."


def what_is_compared() -> str:
    """Describe what the band model is compared with, where its bands lie where they are sent."""
    return (
        "The band model is drawn with the exact length of each run of chips, so that its bands lie "
        "where those of the simulation do: compare the width and levels of the bands of a packet. "
        f"Read literally, in whole columns, it drifts: the field “{_FIELD}” under Model."
    )


def why_it_drifts() -> str:
    """Explain the drift, and what can be done about it."""
    return (
        "The band model rounds each band to whole columns, and leaves out the exposure between two "
        "equal chips. Both add up along the picture, so that its bands drift away from those of "
        f"the simulation. The field “{_FIELD}” under Model aligns them: exact run lengths, so that "
        "width and levels of the bands can be compared packet by packet."
    )
