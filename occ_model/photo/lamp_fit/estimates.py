"""Estimate a lamp's frequency or the readout time, its duty and the exposure from its stripes."""

import math
from dataclasses import dataclass

from occ_model.photo.lamp_fit.read_lamp import LampReading
from occ_model.photo.lamp_fit.readings import StripeReading, readings_of
from occ_model.photo.lamp_fit.verdict import floor_limit

DUTY_ERROR = 0.02  # what tone curves outside the model add to the error of a duty that is known
_SAME = 2.0  # deviations within which two duties are the same
_NOTE_ERROR, _FAR_NOTE = math.log(1.3), math.log(1.6)
"""Logarithms of the usual ratio of a noted exposure to the one found, and of a doubtful one."""


@dataclass(frozen=True, eq=False, slots=True)
class LampEstimates:
    """What stripes say of a lamp whose frequency, or the readout time, is known."""

    reading: LampReading
    estimate: str  # "readout_time" or "lamp_frequency", whichever is not known
    frequency: float  # Hz
    readout: float  # Seconds a line
    known_duty: float | None  # None if it is read from the stripes
    noted: float | None  # Exposure time in seconds that the camera noted
    chosen: StripeReading
    others: tuple[StripeReading, ...]  # Other duties and exposures that make the same stripes

    @property
    def duty(self) -> float:
        return self.chosen.duty if self.known_duty is None else self.known_duty

    @property
    def exposure_time(self) -> float:
        return self.chosen.exposure / self.frequency

    @property
    def is_confirmed(self) -> bool:
        """Whether a noted exposure, or a known duty and its floor, agrees with the stripes."""
        if self.known_duty is None:
            return self.noted is not None and not self.is_far_from_note
        return abs(self.chosen.floor - self.reading.fit.floor) <= floor_limit(self.reading.cues)

    @property
    def is_far_from_note(self) -> bool:
        """Whether the camera noted another exposure time."""
        noted = self.noted
        return noted is not None and abs(math.log(self.exposure_time / noted)) > _FAR_NOTE

    @property
    def start_time(self) -> float:
        """The time in seconds from the lamp's lighting up to the first column's exposure."""
        place = self.reading.column + self.reading.place.region.first_column
        centred = 0.5 * self.duty - 0.5 * self.chosen.exposure - place / self.reading.period
        return centred % 1.0 / self.frequency

    @property
    def uncertainties(self) -> dict[str, float]:
        """Standard deviations by the names of the scene's parameters, in SI units."""
        errors, period = self.reading.errors, 1.0 / self.frequency
        of_duty, of_exposure = errors.shape_errors(self.chosen)
        of_place = errors.place * self.reading.step * self.readout
        value = self.readout if self.estimate == "readout_time" else self.frequency
        found = {
            "exposure_time": of_exposure * period,
            "start_time": math.hypot(of_place, 0.5 * math.hypot(of_duty, of_exposure) * period),
            self.estimate: errors.period / self.reading.fit.wave.period * value,
        }
        return found if self.known_duty is not None else {**found, "duty": of_duty}


def estimate_lamp(
    reading: LampReading,
    *,
    frequency: float,
    readout: float,
    estimate: str,
    known_duty: float | None,
    noted: float | None,
) -> LampEstimates:
    """Estimate the lamp's frequency, or the readout time, from the other one.

    Of the duties and exposures that make the stripes, that is chosen which agrees best with the
    light between them and with a known duty, or else with the noted exposure.
    """
    if estimate == "readout_time":
        readout = 1.0 / (frequency * reading.period)
    else:
        estimate, frequency = "lamp_frequency", 1.0 / (readout * reading.period)
    floor, most = reading.fit.floor, floor_limit(reading.cues)

    def distance(one: StripeReading) -> float:
        known = 0.0
        if known_duty is not None:
            error = math.hypot(reading.errors.shape_errors(one)[0], DUTY_ERROR)
            known = (one.duty - known_duty) / (_SAME * error)
        elif noted is not None:
            known = math.log(one.exposure / (noted * frequency)) / _NOTE_ERROR
        return math.hypot((one.floor - floor) / most, known)

    first, *rest = sorted(
        readings_of(reading.fit.wave.width, reading.fit.wave.ramp_part), key=distance
    )
    apart = _SAME * max(reading.errors.shape_errors(first))
    others = tuple(
        one
        for one in rest
        if distance(one) < distance(first) + 1.0 and abs(one.exposure - first.exposure) > apart
    )
    return LampEstimates(reading, estimate, frequency, readout, known_duty, noted, first, others)
