"""Lamps are read by the shape of their stripes, and other regular things are not."""

from collections.abc import Callable
from contextlib import suppress

import numpy as np
import pytest
from model.photo.lamp_fit.lamp_pictures import (
    FREQUENCY,
    OTHER_THINGS,
    LampPicture,
    draw_lamp,
    is_near,
    lit,
    photo_of,
    readout_of,
    srgb,
)

import occ_model as occ
from occ_model.photo.lamp_fit.readings import readings_of

SCENE = occ.load_preset("phone-136us").replace(light="lamp", lamp_frequency=FREQUENCY)


def match(picture: LampPicture, **how: str) -> occ.Match:
    return occ.match_photo(picture.photo, SCENE, **how)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("duty", "exposure", "periods"), [(0.3, 0.12, 7.7), (0.5, 0.07, 4.3), (0.62, 0.2, 15.2)]
)
def test_a_round_lamp_with_few_stripes_is_read_surely(
    duty: float, exposure: float, periods: float
) -> None:
    picture = draw_lamp(np.random.default_rng(5), duty=duty, exposure=exposure, periods=periods)
    found = match(picture)
    errors = found.uncertainties
    assert found.verdict == "sure"
    assert found.lamp_frequency == FREQUENCY
    right = readout_of(picture.period)
    assert is_near(found.readout_time, right, errors["readout_time"], 4.0)
    assert is_near(found.duty or 0.0, duty, errors["duty"], 4.0)
    exposed, error = found.exposure_time * FREQUENCY, errors["exposure_time"] * FREQUENCY
    assert is_near(exposed, exposure, error, 4.0)
    assert abs(found.readout_time / right - 1.0) < 0.01


def test_a_known_duty_or_a_noted_exposure_decides_between_the_readings() -> None:
    picture = draw_lamp(np.random.default_rng(6), duty=0.12, exposure=0.35, periods=9.0)
    unknown = match(picture)
    assert unknown.other_exposures
    assert unknown.exposure_reasons
    scene = SCENE.replace(duty=0.12)
    known = occ.match_photo(picture.photo, scene, sent="scene")
    assert known.duty == 0.12
    assert known.exposure_time * FREQUENCY == pytest.approx(0.35, abs=0.03)
    assert not known.other_exposures


@pytest.mark.parametrize("draw", OTHER_THINGS)
def test_other_regular_things_are_never_sure(
    draw: Callable[[np.random.Generator], occ.Photo],
) -> None:
    photo = draw(np.random.default_rng(3))
    verdict = "refused"
    with suppress(occ.MatchError):
        verdict = occ.match_photo(photo, SCENE).verdict
    assert verdict in ("refused", "doubtful")


@pytest.mark.parametrize("together", [2, 4])
def test_lines_that_a_sensor_reads_together_are_averaged(together: int) -> None:
    random = np.random.default_rng(7)
    groups = np.repeat(np.arange(480 // together) * together, together).astype(np.float64)
    stripes = np.tile(lit(groups / 23.7, 0.45, 0.2), (24, 1))
    light = np.clip(0.6 * stripes / stripes.max() + random.normal(0.0, 0.004, stripes.shape), 0, 1)
    found = occ.match_photo(photo_of(srgb(light)), SCENE)
    assert found.verdict == "sure"
    assert found.readout_time == pytest.approx(readout_of(23.7), rel=2e-3)


def test_readings_make_the_same_stripes() -> None:
    start = np.linspace(0.0, 1.0, 2001)[:-1]
    for width, ramp in ((0.5, 0.1), (0.3, 0.25), (0.8, 0.15)):
        shapes = []
        for one in readings_of(width, ramp)[:8]:
            light = lit(start, one.duty, one.exposure) * one.exposure
            swing = float(np.ptp(light))
            assert float(light.min()) / swing == pytest.approx(one.floor, abs=1e-9)
            # About the middle of the stripe, wherever that is in the cycle.
            shapes.append(np.sort((light - light.min()) / swing))
        for shape in shapes[1:]:
            np.testing.assert_allclose(shape, shapes[0], atol=1e-9)
