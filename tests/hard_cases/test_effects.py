"""Effects where their closed forms cancel, compared with rational arithmetic and 50 digits."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import strategies as st

from hard_cases.laws import cases, record
from hard_cases.references import STARTS, decades, signed_decades, some_columns, within
from occ_model.camera.optics import Gain, Optics
from occ_model.camera.projection import rotation_of
from occ_model.effects.effect import OpticsEffect
from occ_model.effects.light_effects import Flicker, ambient_fractions
from occ_model.effects.optics_effects import Emission, Vignetting
from occ_model.light.sent import flicker_of
from occ_model.scene.scene import Scene

mpmath.mp.dps = 50


@cases(
    frequency=decades(0.01, 1e9), depth=st.floats(0.0, 1.0), phase=st.floats(-math.pi, math.pi),
    cycles=st.one_of(decades(1e-11, 1e9), st.integers(1, 10**6).map(float)),
    ulps=st.integers(-1, 1), start=STARTS,
)  # fmt: skip
def test_flicker_is_that_of_its_integral_in_fifty_digits(
    frequency: float, depth: float, phase: float, cycles: float, ulps: int, start: float
) -> None:
    exposure = within("exposure_time", cycles / frequency)
    if ulps:
        exposure = within("exposure_time", math.nextafter(exposure, ulps * math.inf))
    scene = Scene().replace(
        flicker_frequency=frequency, flicker_depth=depth, flicker_phase=phase,
        exposure_time=exposure, start_time=start, columns=300,
    )  # fmt: skip
    # Exact except for the fraction of a cycle, in which no digits are lost.
    length = Fraction(frequency) * Fraction(exposure)
    turn = mpmath.mpf(length.numerator) / length.denominator
    exact = mpmath.sinpi(turn) / (mpmath.pi * turn)
    found = flicker_of(scene).response(Fraction(scene.camera.exposure_time))
    relative = float(abs(found - exact) / abs(exact)) if exact else abs(found)
    record("flicker's part of an exposure, relative", "F t 1e-11 to 1e9, +- 1 ulp", relative, 1e-15)
    worst = 0.0
    for column in some_columns(scene):
        when = Fraction(start) + column * Fraction(scene.camera.readout_time)
        middle = ((when + Fraction(exposure) / 2) * Fraction(frequency)) % 1
        angle = 2 * mpmath.pi * mpmath.mpf(middle.numerator) / middle.denominator + phase
        fraction = 1 + depth * exact * mpmath.cos(angle)
        worst = max(worst, abs(float(ambient_fractions(scene)[column] - fraction)))
    record("flickering light, of its mean", "F 0.01 Hz to 1 GHz, t_0 to 1e9 s", worst, 1e-14)


@pytest.mark.parametrize(
    ("frequency", "exposure"),
    [
        (0.01, 1e-9),  # F t = 1e-11: the sine equals its angle to the last digit
        (1.0, 1e-9),  # F t = 1e-9
        (100.0, 0.01),  # F t is whole except for the rounding of 0.01
        (128.0, 1 / 128),  # F t is exactly 1: the result must be 0 although pi is rounded
        (2.0**20, 1e6),  # 1e12 cycles exactly
        (120.0, math.nextafter(1 / 120, 1)),  # one ulp beyond a whole cycle
    ],
)
def test_whole_cycles_leave_nothing_and_short_exposures_all(
    frequency: float, exposure: float
) -> None:
    scene = Scene().replace(flicker_frequency=frequency, exposure_time=exposure, flicker_depth=1.0)
    turn = Fraction(frequency) * Fraction(exposure)
    found = flicker_of(scene).response(Fraction(scene.camera.exposure_time))
    if turn.denominator == 1:
        assert found == 0.0
        assert not Flicker().is_present(scene)
    else:
        exact = mpmath.sinpi(mpmath.mpf(turn.numerator) / turn.denominator)
        exact /= mpmath.pi * mpmath.mpf(turn.numerator) / turn.denominator
        assert found == pytest.approx(float(exact), rel=1e-15, abs=0)


def gain_of(effect: OpticsEffect, scene: Scene) -> np.ndarray:
    """Return an effect's factor on each pixel's light."""
    optics = effect.apply(scene, Optics(np.zeros((4, 2))))
    (gain,) = (*optics.emission, *optics.transmission)
    assert isinstance(gain, Gain)
    rows = np.arange(scene.camera.rows, dtype=np.float64)
    return gain.at(rows, slice(None)).astype(np.float64)


def corner_rays(scene: Scene) -> list[tuple[int, int, mpmath.matrix]]:
    """Return the picture's corners and middle, and their rays (x, y, 1)."""
    camera = scene.camera
    rows, columns = camera.rows, camera.columns
    focal = mpmath.mpf(camera.equivalent_focal_length) / mpmath.mpf(0.04327)
    focal *= mpmath.sqrt(rows**2 + columns**2)
    places = [(0, 0), (rows - 1, columns - 1), (0, columns - 1), (rows // 2, columns // 2)]
    return [
        (r, c, mpmath.matrix([(c - mpmath.mpf(columns - 1) / 2) / focal,
                              (r - mpmath.mpf(rows - 1) / 2) / focal, 1]))
        for r, c in places
    ]  # fmt: skip


@cases(
    focal=decades(1e-3, 2.0), exponent=st.one_of(decades(1e-18, 20.0), st.just(20.0)),
    rows=st.integers(1, 24), columns=st.integers(1, 48),
)  # fmt: skip
def test_vignetting_at_a_fisheyes_corner_is_that_of_fifty_digits(
    focal: float, exponent: float, rows: int, columns: int
) -> None:
    scene = Scene().replace(
        equivalent_focal_length=focal, vignetting_exponent=exponent, rows=rows, columns=columns
    )
    gain = gain_of(Vignetting(), scene)
    worst = 0.0
    for row, column, ray in corner_rays(scene):
        exact = mpmath.norm(ray) ** -exponent
        worst = max(worst, float(abs(gain[row, column] - exact) / exact))
    ranges = "focal length from 1 mm, cos^0 to cos^20"
    # Single precision, to the tenth power.
    record("vignetting's gain, relative", ranges, worst, 2e-5)
    assert gain.min() > 0.0
    assert gain.max() <= 1.0


@cases(
    yaw=st.one_of(st.floats(-1.5706, 1.5706), signed_decades(1.57, 1.5706)),
    pitch=st.one_of(st.just(0.0), st.floats(-1.5706, 1.5706)), roll=st.floats(-math.pi, math.pi),
    focal=decades(1e-3, 2.0), order=decades(1e-15, 99.0).map(lambda above: 1.0 + above),
)  # fmt: skip
def test_emission_is_that_of_fifty_digits_at_grazing_angles(
    yaw: float, pitch: float, roll: float, focal: float, order: float
) -> None:
    scene = Scene().replace(
        yaw=yaw, pitch=pitch, roll=roll, equivalent_focal_length=focal, lambertian_order=order,
        rows=24, columns=48,
    )  # fmt: skip
    gain, normal = gain_of(Emission(), scene), rotation_of(scene.pose)[:, 2].tolist()
    worst = 0.0
    for row, column, ray in corner_rays(scene):
        along = sum(mpmath.mpf(n) * ray[i] for i, n in enumerate(normal))
        exact = (abs(along) / mpmath.norm(ray)) ** (mpmath.mpf(order) - 1)
        worst = max(worst, abs(float(gain[row, column] - exact)))
    ranges = "turned to 89.99 deg, cos^0 to 99"
    # Rays of single precision, to the 99th power.
    record("emission's gain, of the light on the axis", ranges, worst, 2e-5)
    assert gain.min() >= 0.0
    assert gain.max() <= 1.0
