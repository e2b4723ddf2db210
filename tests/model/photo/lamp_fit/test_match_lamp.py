"""Lamps are read by the shape of their stripes."""

from dataclasses import replace
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from model.photo.lamp_fit.lamp_pictures import (
    FREQUENCY,
    LampPicture,
    draw_lamp,
    is_near,
    lit,
    photo_of_light,
    readout_of,
)
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.lamp_fit.fit import LampFit, fit_lamp
from occ_model.photo.lamp_fit.match import match_lamp
from occ_model.photo.lamp_fit.model import AMBIENT
from occ_model.photo.lamp_fit.place import find_place
from occ_model.photo.lamp_fit.profile import LampProfile
from occ_model.photo.lamp_fit.read_lamp import read_lamp
from occ_model.photo.lamp_fit.readings import readings_of
from occ_model.photo.match_facts import format_facts, match_facts
from occ_model.photo.reading.load import region_within

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


def test_exchanging_duty_and_exposure_exchanges_their_errors() -> None:
    photo = draw_lamp(np.random.default_rng(6), duty=0.12, exposure=0.35, periods=9.0).photo
    place = find_place(photo, region_within(photo, None))
    assert place is not None
    reading = read_lamp(place, is_linear=False)
    short, long = (
        occ.match_photo(replace(photo, exposure_time=noted / FREQUENCY), SCENE)
        for noted in (0.12, 0.35)
    )
    assert short.duty == pytest.approx(long.exposure_time * FREQUENCY, rel=0.05)
    for match, of_duty, of_exposure in (
        (short, reading.errors.width, reading.errors.ramp),
        (long, reading.errors.ramp, reading.errors.width),
    ):
        assert match.uncertainties["duty"] == pytest.approx(of_duty)
        assert match.uncertainties["exposure_time"] == pytest.approx(of_exposure / FREQUENCY)
    assert reading.errors.width != pytest.approx(reading.errors.ramp, rel=0.05)


def test_what_needs_no_known_time_does_not_depend_on_the_assumed_one() -> None:
    """Where neither frequency nor readout time is known, either may be assumed."""
    photo = draw_lamp(np.random.default_rng(5), duty=0.3, exposure=0.12, periods=7.7).photo
    assumed = [
        occ.match_photo(photo, SCENE.replace(lamp_frequency=hertz)) for hertz in (300.0, 4000.0)
    ] + [
        occ.match_photo(photo, SCENE.replace(readout_time=line), estimate="switching_frequency")
        for line in (3e-6, 30e-6)
    ]  # fmt: skip
    first = assumed[0]
    for other in assumed:
        frequency = other.lamp_frequency or 0.0
        estimate = other.uncertainties[other.estimate] / getattr(other, other.estimate)
        assert other.verdict == first.verdict
        assert other.columns_per_chip == pytest.approx(first.columns_per_chip, rel=1e-4)
        assert other.duty == pytest.approx(first.duty, abs=1e-3)
        assert other.exposure_in_periods == pytest.approx(first.exposure_in_periods, rel=0.02)
        assert other.uncertainties["exposure_time"] * frequency == pytest.approx(
            first.uncertainties["exposure_time"] * 300.0, rel=1e-3
        )
        assert estimate == pytest.approx(
            first.uncertainties["readout_time"] / first.readout_time, rel=1e-2
        )


def test_the_scene_of_a_match_begins_where_the_photo_does() -> None:
    found = match(draw_lamp(np.random.default_rng(5), duty=0.3, exposure=0.12, periods=7.7))
    region = found.region
    simulated = occ.column_profile(found.scene)[region.first_column : region.last_column]
    assert np.corrcoef(found.stripes.flattened, simulated)[0, 1] > 0.97


def test_a_match_can_be_ended_while_it_fits() -> None:
    picture = draw_lamp(np.random.default_rng(5), duty=0.3, exposure=0.12, periods=7.7)
    whole = region_within(picture.photo, None)
    stop = Mock(side_effect=[None, None, InterruptedError])
    with pytest.raises(InterruptedError):
        match_lamp(
            picture.photo, SCENE, whole, estimate="readout_time", is_duty_known=False, check=stop
        )
    assert stop.call_count == 3


def stripes(shift: float = 0.0, floor: float = 0.0, exposure: float = 0.2) -> occ.Photo:
    """Photograph an evenly lit lamp, shifted by some columns from the first row to the last."""
    random, rows = np.random.default_rng(9), 40
    columns = np.arange(300.0) - np.linspace(0.0, shift, rows)[:, None]
    light = lit(columns / 21.3, 0.4, exposure)
    light = floor + (1.0 - floor) * light / light.max()
    return photo_of_light(0.6 * light + random.normal(0.0, 0.003, light.shape))


@pytest.mark.parametrize(
    ("photo", "said"),
    [
        (stripes(shift=6.0), "The stripes are not upright"),
        (stripes(floor=0.15), "more or less light than any duty and exposure leave"),
        (stripes(exposure=1.2), "as with an exposure of a period or more"),
    ],
)
def test_what_no_shutter_makes_of_a_lamp_is_doubted(photo: occ.Photo, said: str) -> None:
    whole = region_within(photo, None)
    match = match_lamp(photo, SCENE, whole, estimate="readout_time", is_duty_known=False)
    assert match.verdict == "doubtful"
    assert any(said in reason for reason in match.reasons)
    upright = match_lamp(stripes(), SCENE, whole, estimate="readout_time", is_duty_known=False)
    assert upright.verdict == "sure"


@pytest.mark.parametrize(("together", "said"), [(2, "two"), (4, "four")])
def test_lines_that_a_sensor_reads_together_are_averaged_and_told(together: int, said: str) -> None:
    random = np.random.default_rng(7)
    groups = np.repeat(np.arange(480 // together) * together, together).astype(np.float64)
    even = np.tile(lit(groups / 23.7, 0.45, 0.2), (24, 1))
    light = 0.6 * even / even.max() + random.normal(0.0, 0.004, even.shape)
    photo = photo_of_light(light)
    profile = LampProfile.of(photo.samples / 255.0, np.ones(photo.samples.shape, dtype=bool))
    assert profile.lines_at_once() == (together, 0)
    apart = stripes().samples / 255.0
    assert LampProfile.of(apart, np.ones(apart.shape, dtype=bool)).lines_at_once() == (1, 0)
    found = occ.match_photo(photo, SCENE)
    assert found.verdict == "sure"
    assert found.readout_time == pytest.approx(readout_of(23.7), rel=2e-3)
    assert found.lines_at_once == together
    told = "\n".join(format_facts(match_facts(found)))
    assert f"lines read together   this camera reads {said} lines at a time" in told
    one = occ.match_photo(stripes(), SCENE)
    assert one.lines_at_once == 1
    assert "lines" not in [fact.key for fact in match_facts(one)]


@pytest.mark.parametrize("period", [60, 90])
def test_sharp_edges_whole_groups_apart_are_no_lines_that_are_read_together(period: int) -> None:
    """Nothing but their distances, which are even, would say so."""
    on = np.arange(720) % period < period // 5
    pixels = np.tile(np.where(on, 0.7, 0.05), (40, 1))
    noise = np.random.default_rng(6).normal(0.0, 1e-3, pixels.shape)
    for seen in (pixels, pixels + noise):
        assert LampProfile.of(seen, np.ones(seen.shape, dtype=bool)).lines_at_once() == (1, 0)


def test_the_errors_of_sharp_edges_hold_where_lines_may_be_read_together() -> None:
    """Edges of five groups of four lines a period, less a little, all lie on whole groups."""
    groups = np.repeat(np.arange(36.0) * 4.0, 4)
    on = (groups + 1.0) % 19.9 < 9.95
    random = np.random.default_rng(8)
    light = 0.6 * np.tile(on, (24, 1)) + random.normal(0.0, 0.004, (24, 144))
    found = occ.match_photo(photo_of_light(light), SCENE)
    error = found.uncertainties["readout_time"]
    assert found.lines_at_once == 1
    assert is_near(found.readout_time, readout_of(19.9), error, 3.0)
    assert error / found.readout_time > 2e-3


def test_sharp_edges_at_one_place_within_columns_leave_the_period_less_known() -> None:
    random, columns, stated = np.random.default_rng(3), 150, []
    for period in (12.0, 12.37):
        on = (np.arange(columns) + 0.2) % period < 0.5 * period
        light = 0.6 * np.tile(on, (24, 1)) + random.normal(0.0, 0.004, (24, columns))
        found = occ.match_photo(photo_of_light(light), SCENE)
        error = found.uncertainties["readout_time"]
        assert is_near(found.readout_time, readout_of(period), error, 3.0)
        stated.append(error / found.readout_time)
    assert stated[0] > 1.5 * stated[1], stated


@pytest.mark.parametrize(("duty", "verdict"), [(0.4, "sure"), (0.33, "doubtful")])
def test_light_between_the_stripes_is_explained_by_the_lamps_duty(
    duty: float, verdict: str
) -> None:
    photo = stripes(exposure=1.3)
    found = occ.match_photo(photo, SCENE.replace(duty=duty), sent="scene")
    assert found.verdict == verdict
    assert occ.match_photo(photo, SCENE).verdict == "doubtful"
    assert any("tells whole periods of an exposure badly" in why for why in found.exposure_reasons)
    if verdict == "sure":
        assert found.exposure_time * FREQUENCY == pytest.approx(1.3, abs=0.05)


def test_a_known_duty_that_is_not_the_stripes_own_is_doubted() -> None:
    photo = stripes()
    own, other = (
        occ.match_photo(photo, SCENE.replace(duty=duty), sent="scene") for duty in (0.39, 0.55)
    )
    assert (own.verdict, own.duty) == ("sure", 0.39)
    assert other.verdict == "doubtful"
    assert "; the scene sends 55 %." in other.reasons[-1]


@pytest.mark.parametrize("gamma", [1.9, 2.4])
def test_gamma_is_estimated_on_request(gamma: float) -> None:
    columns = np.arange(400.0)
    even = np.tile(lit(columns / 31.3, 0.45, 0.6), (40, 1))
    light = np.clip(0.7 * even / even.max(), 0.0, 1.0) ** (1.0 / gamma)
    noise = np.random.default_rng(4).normal(0.0, 0.004, light.shape)
    photo = photo_of(np.clip(np.rint(255.0 * (light + noise)), 0.0, 255.0).astype(np.uint8))
    found = occ.match_photo(photo, SCENE, fit_gamma=True)
    assert abs(found.gamma - gamma) < 2.0 * found.uncertainties["gamma"] < 0.5
    assert found.scene.camera.gamma == found.gamma
    given = occ.match_photo(photo, SCENE)
    assert given.gamma == SCENE.camera.gamma
    assert "gamma" not in given.uncertainties


@pytest.mark.parametrize(
    ("columns", "shortest", "step"),
    [(640, 500.0, 1), (641, 500.0, 2), (6400, 500.0, 10), (6400, 480.0, 10), (6400, 479.0, 9),
     (6400, 95.0, 1), (6400, 96.0, 2), (100, 5.0, 1)],
)  # fmt: skip
def test_columns_are_averaged_while_periods_keep_enough_of_them(
    columns: int, shortest: float, step: int
) -> None:
    """A profile keeps at most 640 columns, but at least 48 of a period."""
    flat = np.zeros(columns)
    assert LampProfile(flat, flat, flat > 0.0).reduction(shortest) == step


def test_a_wide_lamp_has_the_period_of_all_its_columns() -> None:
    random = np.random.default_rng(2)
    light = np.tile(lit(np.arange(1600.0) / 310.7, 0.4, 0.1), (24, 1))
    light = 0.6 * light / light.max() + random.normal(0.0, 0.004, light.shape)
    found = occ.match_photo(photo_of_light(light), SCENE)
    assert found.verdict == "sure"
    assert found.readout_time == pytest.approx(readout_of(310.7), rel=1e-3)


def test_stripes_without_a_height_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def fit_dark_end(*known: Any, **how: Any) -> list[LampFit]:
        (fit, *_) = fit_lamp(*known, **how)
        values = fit.values.copy()
        values[AMBIENT], values[-1] = -1e-9, -40.0  # lit columns at the end are as dark as others
        return [replace(fit, values=values)]

    monkeypatch.setattr("occ_model.photo.lamp_fit.read_lamp.fit_lamp", fit_dark_end)
    with pytest.raises(occ.MatchError, match="dark and lit stripes are equally bright"):
        occ.match_photo(stripes(), SCENE)


def test_evidence_is_finite_where_white_hides_all_stripes() -> None:
    white = LampProfile(np.full(120, 0.99), np.full(120, 1e-6), np.full(120, True))
    for fit in fit_lamp(white, [20.0]):
        assert np.isfinite(fit.score)
        assert np.isfinite(fit.covariance).all()


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
