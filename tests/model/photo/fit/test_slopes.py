"""Slopes are the limits of differences: of the light, the tone curve, a profile, and all together.

A difference over a small change has an error that shrinks with the change, but for corners that it
crosses, and for what the arithmetic's rounding leaves.
"""

from collections.abc import Callable

import cv2
import numpy as np
import pytest
from lit_fractions import blurred_light

from occ_model.photo.fit.joint_model import PRIORS, JointModel
from occ_model.photo.fit.seen_stripes import BlurShape, blur_kernel, kernel_slope
from occ_model.photo.fit.timing import Timing
from occ_model.photo.fit.tone_curve import ToneCurve
from occ_model.photo.stripes.evenly_lit import EvenProfile

COLUMNS = 240
CHIPS = np.array([1, 0, 0, 1, 1, 0, 1, 0, 1, 1], dtype=np.uint8)
SHAPES: tuple[BlurShape, ...] = ("normal", "box", "exponential")

Vector = Callable[[np.ndarray], np.ndarray]


def central(function: Vector, here: np.ndarray, change: float) -> np.ndarray:
    """Return central differences of a function, shape (parameters, values)."""
    steps = change * np.eye(len(here))
    sides = [(function(here + step) - function(here - step)) / (2.0 * change) for step in steps]
    return np.stack(sides)


def off(slopes: np.ndarray, differences: np.ndarray, fraction: float = 0.9) -> np.ndarray:
    """Return the error of each parameter within which a fraction lies, over its largest slope.

    A difference whose change crosses a corner is no limit there: few of them are.
    """
    largest = np.maximum(np.abs(differences).max(axis=1), 1e-12)
    return np.asarray(np.quantile(np.abs(slopes - differences), fraction, axis=1) / largest)


def drawn(seed: int) -> np.ndarray:
    """Draw parameters: step, exposure and middle, four of the tone, blur and longer."""
    random = np.random.default_rng(seed)
    low = [0.05, 0.2, 0.0, -0.15, 0.0, -0.3, -0.4, 0.3, -0.1]
    high = [0.2, 2.5, 10.0, 0.15, 0.08, 0.3, 0.4, 1.6, 0.1]
    return np.asarray(random.uniform(low, high))


def test_a_picture_that_is_sharp_stays_so_with_hardly_more_blur() -> None:
    assert not kernel_slope(0.0, "normal").any()
    assert blur_kernel(0.0) == pytest.approx(blur_kernel(0.04))


CURVES = (
    ToneCurve(2.2, 0.03),
    ToneCurve(2.4, 0.055, -0.3, 0.2),
    ToneCurve(1.0, 0.0, 0.3, 0.1),
    ToneCurve(1.8, 0.01, 0.9, 1.4),
    # Its least slope straightens a part of it.
    ToneCurve(2.2, -0.05, -0.7, -0.8),
)


@pytest.mark.parametrize("curve", CURVES)
def test_the_grey_levels_of_light_change_by_their_slopes(curve: ToneCurve) -> None:
    """Beyond both ends too, where the curve goes on straight."""
    table = curve.table()
    light = np.linspace(table.light[0] - 0.01, 1.3, 200)
    here = np.array([curve.gamma, curve.offset, curve.shoulder, curve.contrast])
    by_tone = central(lambda at: ToneCurve(*at.tolist()).table().value_of(light), here, 1e-7)
    by_light = (table.value_of(light + 1e-8) - table.value_of(light - 1e-8)) / 2e-8
    # Over the light itself, and over the four parameters.
    itself = np.eye(5)[:, :1].repeat(len(light), axis=1)
    found = curve.slopes(table).of_values(table.value_of(light), itself)
    assert off(found, np.vstack([by_light, by_tone])).max() < 1e-6


SCALE = np.array([0.1 / COLUMNS, *[0.02] * 2, *[deviation for _, deviation in PRIORS.values()]])
"""Changes of the parameters that matter about as much."""


def profiles_of(
    values: np.ndarray, noise: float, brightest: float, *, gamma: float, values_blurred: bool
) -> list[EvenProfile]:
    """Return two profiles under uneven light, one of them half as bright."""
    step, exposure, middle, *bends, blur, longer = values.tolist()
    table = ToneCurve(gamma * np.exp(bends[0]), *bends[1:]).table()
    timing, sharp = Timing(step, exposure, middle, 2.2), values_blurred
    lit = blurred_light(CHIPS, COLUMNS, timing, 0.0 if sharp else blur, longer)
    random, profiles = np.random.default_rng(5), []
    for bright in (brightest, 0.5 * brightest):
        grey = table.value_of(0.05 + bright * np.linspace(1.0, 0.7, COLUMNS) * lit)
        if values_blurred:
            kernel = blur_kernel(blur)[None]
            grey = cv2.filter2D(grey[None], -1, kernel, borderType=cv2.BORDER_REPLICATE)[0]
        grey = grey + noise * random.normal(size=COLUMNS)
        profiles.append(EvenProfile(np.minimum(grey, 255.0), grey < 255.0, 20.0))
    return profiles


@pytest.mark.parametrize("brightest", [0.5, 1.5])
@pytest.mark.parametrize("noise", [3.0, 10.0])
@pytest.mark.parametrize("values_blurred", [False, True])
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("gamma", "wide"), [(2.2, False), (2.2, True), (1.0, False)])
def test_half_of_the_slopes_are_off_by_less_than_the_residuals_part(
    brightest: float, noise: float, values_blurred: bool, shape: BlurShape, gamma: float, wide: bool
) -> None:
    """What is left out of them has the residual as a factor: it is small beside the stripes."""
    true = drawn(1)
    if gamma == 1.0:  # of pixel values that are averaged, whose gamma and offset are not fitted
        true[3:5] = 0.0
    profiles = profiles_of(true, noise, brightest, gamma=gamma, values_blurred=values_blurred)
    model = JointModel(
        profiles, CHIPS, float(true[0]), gamma, values_blurred=values_blurred, wide=wide
    )
    swing = min(np.ptp(one.values[one.kept]) for one in profiles)

    def residual(scaled: np.ndarray) -> np.ndarray:
        return model.residual(true + scaled * SCALE, shape)

    slopes = model.slopes(true, shape) * SCALE[:, None]
    wrong = off(slopes, central(residual, np.zeros(9), 1e-3), 0.5)
    left = np.sqrt(np.nanmean(model.misfit_of_columns(true)))
    assert wrong.max() < left / swing
