"""Why the duty and the exposure that stripes show are doubted, in sentences."""

import math

from occ_model.errors import distinct_texts
from occ_model.photo.lamp_fit.cues import Cues
from occ_model.photo.lamp_fit.estimates import DUTY_ERROR, LampEstimates
from occ_model.scene.units import PERCENT, SECOND

_MOST_DEVIATIONS = 3.0  # standard deviations between a known duty and that of the stripes
_LEAST_RAMP, _LEAST_PERIOD = 1.0, 10.0  # columns from which duty and exposure are sure
_RAMP_BY_NOISE = 200.0  # least ramp in columns, over the residual relative to the stripes' height
_MOST_WHITE = 0.15  # largest fraction of the columns with which duty and exposure are sure


def doubts_by_duty(found: LampEstimates) -> list[str]:
    """Doubt a known duty that is not that of the stripes."""
    known, duty = found.known_duty, found.chosen.duty
    error, _ = found.reading.errors.shape_errors(found.chosen)
    if known is None or abs(duty - known) <= _MOST_DEVIATIONS * math.hypot(error, DUTY_ERROR):
        return []
    return [
        f"The stripes have a duty of {PERCENT.format_estimate(duty, error)}; the scene "
        f"sends {PERCENT.format(known, 3)}."
    ]


def doubts_by_columns(cues: Cues) -> list[str]:
    """Doubt duty and exposure where compression, blur or white hide the stripes' shape."""
    least, found = max(_LEAST_RAMP, _RAMP_BY_NOISE * cues.unexplained), []
    if cues.ramp < least or cues.period < _LEAST_PERIOD:
        found.append(
            f"The stripes' edges last {cues.ramp:.2g} of the {cues.period:.3g} columns of a "
            "period, so that blur and compression hide duty and exposure; at least "
            f"{least:.2g} of {_LEAST_PERIOD:.0f} are needed."
        )
    if cues.white > _MOST_WHITE:
        white, most = distinct_texts(100.0 * cues.white, 100.0 * _MOST_WHITE)
        found.append(
            f"{white} % of the columns have white pixels, which hides duty and exposure; at most "
            f"{most} % are allowed."
        )
    return found


def doubts_by_readings(found: LampEstimates) -> list[str]:
    """Doubt an exposure if others make the same stripes, or the camera noted another one."""
    doubts, noted, seconds = [], found.noted, SECOND.format(found.exposure_time, 3)
    if found.others:
        words = [
            f"a duty of {PERCENT.format(each.duty, 3)} exposed for "
            f"{SECOND.format(each.exposure / found.frequency, 3)}"
            for each in (found.chosen, *found.others[:2])
        ]
        why = "notes no exposure time" if noted is None else "notes one that does not decide"
        doubts.append(
            f"{' or '.join(words).capitalize()}: these make the same stripes, and the photo {why}. "
            "If the duty is known, state that the scene's light is sent."
        )
    if noted is None and found.chosen.floor > 0.0:
        doubts.append(
            "How much light there is between the stripes tells whole periods of an exposure badly, "
            "and the photo notes no exposure time."
        )
    if noted is not None and found.is_far_from_note:
        doubts.append(
            f"The exposure time found, {seconds}, is far from the one that the camera noted, "
            f"{SECOND.format(noted, 3)}."
        )
    return doubts
