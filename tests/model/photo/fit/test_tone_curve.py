"""A tone curve is one curve, looked up from either side, and never falls."""

import numpy as np
import pytest

from occ_model.photo.fit.tone_curve import ToneCurve

CURVES = (
    ToneCurve(2.2),
    ToneCurve(2.4, 0.055),
    ToneCurve(1.0 / 0.45, 0.099, 0.2, -0.3),
    ToneCurve(1.8, 0.0, 0.9, 1.5),
    ToneCurve(2.2, -0.05, -0.9, -0.9),
)
LEVELS = np.arange(1.0, 255.0)


@pytest.mark.parametrize("curve", CURVES)
def test_the_light_of_a_grey_level_makes_the_grey_level(curve: ToneCurve) -> None:
    table = curve.table()
    assert table.value_of(table.light_of(LEVELS)) == pytest.approx(LEVELS, abs=0.02)
    assert table.light_of(np.array([255.0])) == pytest.approx(1.0, abs=1e-12)
    light = table.light_of(LEVELS)
    assert (np.diff(light) > 0.0).all()


@pytest.mark.parametrize("curve", CURVES)
def test_the_slope_of_a_curve_is_that_of_the_grey_levels_over_light(curve: ToneCurve) -> None:
    table = curve.table()
    # The rims of the toe and of the least slope are corners.
    light, step = table.light_of(LEVELS), 1e-5
    rise = (table.value_of(light + step) - table.value_of(light - step)) / (2.0 * step)
    assert np.median(np.abs(table.slope_of(light) / rise - 1.0)) < 0.02
    assert np.median(np.abs(table.slope_at(LEVELS) / rise - 1.0)) < 0.02


def test_beyond_its_ends_it_goes_on_straight() -> None:
    table = CURVES[1].table()
    for end in (table.light[0], table.light[-1]):
        outside = table.value_of(end + np.array([-0.02, 0.0, 0.02]))
        assert (np.diff(outside) > 0.0).all()
    over = table.value_of(1.0 + np.array([0.0, 0.1, 0.3]))
    assert over[0] == pytest.approx(255.0)
    assert over - 255.0 == pytest.approx(255.0 * table.slope[-1] * np.array([0.0, 0.1, 0.3]))
    under = table.value_of(table.light[0] - np.array([0.0, 0.001]))
    assert np.diff(under)[0] == pytest.approx(-255.0 * table.slope[0] * 0.001)


FRACTION = LEVELS / 255.0
BENT = (
    FRACTION
    + 0.2 * FRACTION * (1 - FRACTION)
    - 0.3 * FRACTION * (1 - FRACTION) * (1 - 2 * FRACTION)
)


@pytest.mark.parametrize(
    ("curve", "light"),
    [
        (ToneCurve(2.2), FRACTION**2.2),
        # IEC 61966-2-1, the standard curve of screens: above 0.04045.
        (ToneCurve(2.4, 0.055), ((FRACTION + 0.055) / 1.055) ** 2.4),
        (ToneCurve(2.0, 0.03, 0.2, -0.3), ((BENT + 0.03) / 1.03) ** 2.0),
    ],
    ids=["power", "screens", "bent"],
)
def test_a_curve_above_its_toe_has_its_closed_form(curve: ToneCurve, light: np.ndarray) -> None:
    assert curve.table().light_of(LEVELS)[20:] == pytest.approx(light[20:], rel=1e-3)


def test_a_toe_is_straight_and_has_the_curves_height_and_slope_where_it_begins() -> None:
    fraction = np.array([-0.05, 0.0, 0.01, 0.02])
    light = ToneCurve(2.2).table().light_of(255.0 * fraction)
    tangent = 0.03**2.2 + 2.2 * 0.03**1.2 * (fraction - 0.03)
    assert light == pytest.approx(tangent, abs=1e-6)


def test_where_its_bends_would_make_it_fall_it_rises_by_a_twentieth() -> None:
    """A gamma of 1 leaves the bent curve as it is; the straight one rises by as much as it goes."""
    fraction = np.linspace(-0.1, 1.0, 441)
    table = ToneCurve(1.0, 0.0, -0.7, -0.8).table()
    bent = fraction + fraction * (1.0 - fraction) * (-0.7 - 0.8 * (1.0 - 2.0 * fraction))
    rises = np.diff(bent) / np.diff(fraction)
    assert rises.min() < -0.5
    assert np.diff(table.light) / np.diff(fraction) == pytest.approx(np.maximum(rises, 0.05))
