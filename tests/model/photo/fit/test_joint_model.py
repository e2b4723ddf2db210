"""A joint fit gives back what made the stripes, and names what is unusual of it."""

import math
from itertools import pairwise

import numpy as np
import pytest
from lit_fractions import blurred_light

from occ_model.photo.fit.joint_fit import JointFit
from occ_model.photo.fit.joint_model import PRIORS, JointModel
from occ_model.photo.fit.mean_fit import mirror_exposure, with_blur
from occ_model.photo.fit.seen_stripes import blur_kernel
from occ_model.photo.fit.timing import Timing
from occ_model.photo.fit.tone_curve import ToneCurve
from occ_model.photo.stripes.evenly_lit import EvenProfile

COLUMNS = 240
CHIPS = np.array([1, 0, 0, 1, 1, 0, 1, 0], dtype=np.uint8)
TRUE = np.array([0.09, 0.6, 2.7, 0.1, 0.05, 0.2, -0.2, 0.9, 0.03])
NOISE = 0.3 * np.random.default_rng(3).normal(size=COLUMNS)


def values_of(true: np.ndarray = TRUE, brightest: float = 0.6) -> np.ndarray:
    """Return the grey levels of parameters, those of the camera relative to a gamma of 2.2."""
    step, exposure, middle, gamma, offset, shoulder, contrast, blur, longer = true.tolist()
    lit = blurred_light(CHIPS, COLUMNS, Timing(step, exposure, middle, 2.2), blur, longer)
    table = ToneCurve(2.2 * math.exp(gamma), offset, shoulder, contrast).table()
    return table.value_of(0.04 + (brightest - 0.04) * lit)


def model_of(
    values: np.ndarray, gamma: float = 2.2, *, values_blurred: bool = False, wide: bool = False
) -> JointModel:
    profile = EvenProfile(np.minimum(values, 255.0), values < 255.0, 20.0)
    return JointModel([profile], CHIPS, 0.09, gamma, values_blurred=values_blurred, wide=wide)


def test_what_made_the_stripes_leaves_but_what_is_unusual_of_the_camera() -> None:
    """Six unknowns off what is usual, each in its standard deviations, and no other misfit."""
    model = model_of(values_of())
    mean, deviation = np.array(list(PRIORS.values())).T
    deviation = np.append(deviation[:5], math.hypot(deviation[5], 0.4 * 0.09))
    off = (TRUE[3:] - mean) / deviation
    assert model.distance_from_usual(TRUE) == pytest.approx(np.linalg.norm(off))
    fit = model.fit(TRUE, rounds=0)
    assert fit.values == pytest.approx(TRUE)
    assert fit.prior == pytest.approx(off @ off)
    assert fit.misfit - fit.prior == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize("brightest", [0.6, 1.6])
def test_a_fit_gives_the_timing_back_clipped_or_not(brightest: float) -> None:
    model = model_of(values_of(brightest=brightest) + NOISE)
    start = model.start(Timing(0.0901, 0.63, 2.72, 2.2))
    model.estimate_noise(model.fit(start).values)
    fit = model.fit(start)
    deviations = np.sqrt(np.diag(fit.covariance))[:3]
    assert (np.abs(fit.values - TRUE)[:3] < 3.0 * deviations).all()
    assert (deviations < [2e-4, 0.1, 0.05]).all()
    assert np.linalg.eigvalsh(fit.covariance).min() > 0.0
    assert fit.deviation == deviations[1]
    assert fit.exposure == fit.values[1]


def hot_spot(blur: float, bend: float, *, values_blurred: bool) -> JointFit:
    """Fit stripes under light exp(-bend x^2), blurred as light or as pixel values."""
    columns = 600
    true = np.array([0.09, 0.6, 2.7, 0.0, 0.03, 0.0, 0.0, blur, 0.0])
    wide = columns + 40  # in equal parts beyond both ends
    sharp = blurred_light(CHIPS, wide, Timing(0.09, 0.6, 2.7, 2.2), 0.0, 0.0)
    across = np.arange(wide) - 0.5 * (wide - 1)
    light = np.exp(-bend * across**2) * (0.05 + 0.5 * sharp)
    values, kernel = ToneCurve(2.2, 0.03).table().value_of, blur_kernel(blur)
    seen = (
        np.convolve(values(light), kernel, "same")
        if values_blurred
        else values(np.convolve(light, kernel, "same"))
    )[20:-20]
    profile = EvenProfile(seen, np.ones(columns, dtype=bool), 20.0)
    model = JointModel([profile], CHIPS, 0.09, 2.2, values_blurred=values_blurred)
    model.estimate_noise(true)
    return model.fit(true)


def test_a_blurred_hot_spot_stretches_the_stripes_as_far_as_is_known() -> None:
    """Light E = exp(-k x^2) blurred by s moves edges outwards by 2 k s^2 x: it scales the step."""
    blur, bend = 1.8, 1.2 / 300.0**2
    fit = hot_spot(blur, bend, values_blurred=False)
    stretched = 2.0 * bend * blur**2
    assert fit.values[0] / 0.09 - 1.0 == pytest.approx(-stretched, rel=0.1)
    assert fit.unbiased.values[0] / 0.09 - 1.0 == pytest.approx(0.0, abs=0.05 * stretched)
    assert fit.unbiased.covariance[0, 0] > fit.covariance[0, 0]


@pytest.mark.parametrize("blur", [1.0, 1.8])
def test_a_hot_spot_whose_pixel_values_are_blurred_leaves_the_step(blur: float) -> None:
    """That model blurs the product itself, also at both ends, where stripes go on."""
    bend = 1.2 / 300.0**2
    fit = hot_spot(blur, bend, values_blurred=True)
    stretched = 2.0 * bend * blur**2
    assert fit.values[0] / 0.09 - 1.0 == pytest.approx(0.0, abs=0.05 * stretched)
    assert fit.unbiased.values[0] == fit.values[0]


def test_the_misfit_of_a_joint_fit_is_that_of_the_noise() -> None:
    """As many as there are independent columns: of each four count as one."""
    model = model_of(values_of() + NOISE)
    model.estimate_noise(TRUE)
    fit = model.fit(TRUE)
    assert (fit.misfit - fit.prior) / (COLUMNS / 4.0) == pytest.approx(1.0, abs=0.25)


def test_where_grey_levels_are_averaged_no_tone_is_fitted() -> None:
    model = model_of(values_of() + NOISE, gamma=1.0)
    start = model.start(Timing(0.09, 0.6, 2.7, 1.0))
    assert start[3:5].tolist() == [0.0, 0.0]
    fit = model.fit(start)
    assert fit.values[3:5].tolist() == [0.0, 0.0]
    assert not fit.covariance[3:5].any()
    assert model.adapt(TRUE)[[2, 3, 4, 5]].tolist() == [2.7, 0.0, 0.0, 0.2]


def test_any_gamma_may_be_found_where_it_is_asked_for() -> None:
    far = TRUE.copy()
    far[3] = 0.4
    values = values_of(far) + NOISE
    wide, usual = model_of(values, wide=True), model_of(values)
    assert wide.distance_from_usual(far) < usual.distance_from_usual(far)
    low = wide.fit(np.array([0.09, 0.6, 2.7, -9.0, 0.0, 0.0, 0.0, 0.5, 0.0]), rounds=0)
    assert 2.2 * math.exp(low.values[3]) == pytest.approx(1.0)
    # What is at a bound has no slope there, and is said not to be known.
    assert low.covariance[3, 3] > 1e6


def test_a_blurred_picture_and_blurred_light_are_told_apart_by_the_model() -> None:
    light = model_of(values_of())
    picture = model_of(values_of(), values_blurred=True)
    assert light.fit(TRUE, rounds=0).misfit < picture.fit(TRUE, rounds=0).misfit
    sharp = TRUE.copy()
    sharp[7] = 0.0
    both = [model_of(values_of(sharp), values_blurred=blurred) for blurred in (False, True)]
    alike = [model.fit(sharp, rounds=0).misfit for model in both]
    assert alike[0] == pytest.approx(alike[1], abs=0.05)


def test_edges_that_white_hides_are_not_seen() -> None:
    assert model_of(values_of()).edges_seen(TRUE) == 1.0
    fractions = [
        model_of(values_of(brightest=light)).edges_seen(TRUE) for light in (1.5, 4.0, 40.0)
    ]
    assert all(more > less for more, less in pairwise([1.0, *fractions]))


def test_another_blur_leaves_the_edges_width() -> None:
    """Variances add: t^2/12 and b^2."""

    def width(values: np.ndarray) -> float:
        return float((values[1] / values[0]) ** 2 / 12.0 + values[7] ** 2)

    for blur in (0.2, 1.1, 2.0):
        other = with_blur(TRUE, blur)
        assert other[7] == blur
        assert width(other) == pytest.approx(width(TRUE))
        assert other[[0, 2, 3, 8]].tolist() == TRUE[[0, 2, 3, 8]].tolist()
    # A blur as wide as the edge leaves a short exposure, and no negative one.
    assert with_blur(TRUE, 2.9)[1] == pytest.approx(0.2 * 0.09)


@pytest.mark.parametrize(("exposure", "other"), [(0.97, 1.03), (1.6, 2.4), (3.1, 2.9), (0.3, 0.3)])
def test_the_mirrored_exposure_is_as_far_from_the_nearest_whole_chips(
    exposure: float, other: float
) -> None:
    values = TRUE.copy()
    values[1] = exposure
    found = mirror_exposure(values)
    assert found[1] == pytest.approx(other)
    assert np.delete(found, 1).tolist() == np.delete(TRUE, 1).tolist()
