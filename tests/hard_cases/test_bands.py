"""Bars: their depth from a hundredth to a thousand periods of exposure, in exact fractions."""

from fractions import Fraction
from typing import Any

import mpmath
from hypothesis import strategies as st

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import decades, within
from occ_model.results.bands import Depth
from occ_model.scene.scene import Scene
from occ_model.study.bands.depth import light_depth

PERIODS = decades(1e-2, 1e3)
RANGES = "t 0.01 to 1,000 periods"


def exact(duty: Fraction, periods: Fraction) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Return peak to peak and RMS over the mean: the trapezoid that a pulse leaves of a period.

    Whole periods hold the same light wherever they start. The rest r of one covers a pulse of duty
    d by min(r, d) at most and by r + d - 1, or nothing, at least, with ramps of slope 1 between.
    """
    rest = periods % 1
    ramp = min(duty, rest, 1 - duty, 1 - rest)
    floor = max(Fraction(0), duty + rest - 1)
    top = floor + ramp
    flat_top, flat_floor = abs(duty - rest), 1 - abs(duty - rest) - 2 * ramp
    mean = duty * rest
    square = flat_top * (top - mean) ** 2 + flat_floor * (floor - mean) ** 2
    # Two ramps: the mean square of a line is that of its ends.
    square += (
        2 * ramp * ((top - mean) ** 2 + (top - mean) * (floor - mean) + (floor - mean) ** 2) / 3
    )
    whole = duty * periods
    with mpmath.workdps(50):
        root = mpmath.sqrt(mpmath.mpf(square.numerator) / square.denominator)
        return (
            mpmath.mpf(ramp.numerator) * whole.denominator / ramp.denominator / whole.numerator,
            root * whole.denominator / whole.numerator,
        )


def worst(found: Depth, duty: Fraction, periods: Fraction) -> float:
    """The larger error of both depths, of themselves; where there are no bars, of the mean."""
    peak, root = exact(duty, periods)
    pairs = (found.peak_to_peak, peak), (found.rms, root)
    return max(float(abs(value - true) / (true or 1)) for value, true in pairs)


@cases(duty=st.floats(1e-3, 1.0 - 1e-3), periods=PERIODS)
def test_a_pulse_s_bars_are_as_deep_as_its_closed_form(duty: float, periods: float) -> None:
    error = worst(occ.pulse_depth(duty, periods), Fraction(duty), Fraction(periods))
    record("depth of a pulse's bars, of itself", f"{RANGES}, duty 0.001 to 0.999", error, 1e-12)


LAMPS = st.one_of(
    st.floats(1e-3, 1.0 - 1e-3).map(lambda duty: (duty, {"light": "lamp", "duty": duty}, 1)),
    st.integers(2, 60).flatmap(lambda n: st.tuples(st.integers(1, n - 1), st.just(n))).map(
        lambda of: (Fraction(*of), {"pattern": "1" * of[0] + "0" * (of[1] - of[0])}, of[1])
    ),
)  # fmt: skip


@cases(
    lamp=LAMPS, frequency=decades(1.0, 1e5),
    periods=st.one_of(PERIODS, st.integers(1, 1000).map(float)),
)  # fmt: skip
def test_a_lamp_s_bars_are_as_deep_as_its_closed_form(
    lamp: tuple[Fraction | float, dict[str, Any], int], frequency: float, periods: float
) -> None:
    duty, light, chips = lamp
    scene = Scene().replace(
        **light, lamp_frequency=frequency, switching_frequency=frequency * chips,
        exposure_time=within("exposure_time", periods / frequency), illuminance=0.0,
    )  # fmt: skip
    # Of chips, the rounded switching frequency is that which is sent.
    rate = Fraction(frequency if chips == 1 else scene.transmitter.switching_frequency) / chips
    held = Fraction(scene.camera.exposure_time) * rate
    # Where a rounded time leaves nearly nothing of a period, what counts is small beside the mean.
    error = worst(light_depth(scene), Fraction(duty), held)
    record("depth of a lamp's bars, of itself", f"{RANGES}, 1 Hz to 100 kHz", error, 1e-9)
