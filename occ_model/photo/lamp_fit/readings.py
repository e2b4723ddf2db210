"""The duties and exposures that explain a lamp's stripes equally well."""

from dataclasses import dataclass

MOST_PERIODS = 6  # whole periods of an exposure that are considered


@dataclass(frozen=True, slots=True)
class StripeReading:
    """A duty and an exposure, both as fractions of a period, and the floor that they make.

    The floor is the least light of a column, as a fraction of the stripes' height. The width of the
    stripes is either that of the pulses, or that of the exposures.
    """

    duty: float
    exposure: float
    floor: float
    is_width_of_pulses: bool


def readings_of(width: float, ramp: float) -> tuple[StripeReading, ...]:
    """Return what makes stripes of a width and a ramp, both as fractions of a period.

    Of a duty d and an exposure e below a period, d + e <= 1, the stripes have the width max(d, e)
    and the ramp min(d, e) and reach to darkness. If d + e > 1 they have those of 1 - d and 1 - e,
    over the light of d + e - 1. The two can be exchanged, and each whole period of exposure more
    adds the light of d.
    """
    above = (1.0 - width - ramp) / ramp
    single = (
        (width, ramp, 0.0, True), (ramp, width, 0.0, False),
        (1.0 - ramp, 1.0 - width, above, False), (1.0 - width, 1.0 - ramp, above, True),
    )  # fmt: skip
    return tuple(
        StripeReading(duty, exposure + whole, floor + whole * duty / ramp, is_width_of_pulses)
        for whole in range(MOST_PERIODS + 1)
        for duty, exposure, floor, is_width_of_pulses in single
    )
