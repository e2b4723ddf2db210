"""Each reason of a refusal is true of its photo, and is not stated of one of which it is false."""

import re
from typing import Any

import numpy as np
import pytest
from hypotheses import hypothesis
from simulated_photos import photo_of

import occ_model as occ
from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.evidence.candidates import Candidates
from occ_model.photo.evidence.verdict import Judge
from occ_model.photo.fit.timing import Timing
from occ_model.results.match import PLAIN_STRIPES, Stripes

COLUMNS = np.arange(600)
SQUARE = np.where(COLUMNS // 30 % 2 == 0, 40.0, 200.0)
NOISE = np.random.default_rng(4).standard_normal(600)
SINE = 150.0 + 25.0 * np.sin(2.0 * np.pi * COLUMNS / 300.0)
STEP = np.where(COLUMNS < 300, 40.0, 200.0)
FLASH = np.where((COLUMNS > 200) & (COLUMNS < 300), 200.0, 40.0)


def picture(profile: FloatArray, noise: float = 0.0, rows: int = 60) -> ByteArray:
    deviations = noise * np.random.default_rng(3).standard_normal((rows, len(profile)))
    return np.clip(np.rint(profile + deviations), 0, 255).astype(np.uint8)


def reasons_of(image: ByteArray) -> tuple[str, ...]:
    """Return why a picture has no stripes; nothing where it has some."""
    try:
        occ.find_stripes(photo_of(image))
    except occ.MatchError as error:
        return error.reasons
    return ()


def common_percent(image: ByteArray) -> float:
    """Return the percentage of the squares of all changes along rows that a common row explains."""
    values = np.linalg.svd(np.diff(image.astype(np.float64), axis=1), compute_uv=False) ** 2
    return float(100.0 * values[0] / values.sum())


WHITE = np.where(COLUMNS % 60 < 10, 40.0, 255.0)  # five of six columns

PHOTOS: dict[str, tuple[ByteArray, str | None]] = {
    "15 columns": (picture(SQUARE[:15]), "the photo has 15 columns; at least 16 are needed"),
    "16 columns": (picture(np.resize([40.0, 40.0, 200.0, 200.0], 16)), None),
    "nothing at all": (picture(np.full(600, 90.0)), "the columns differ by 0 grey levels only"),
    # Light that changes by 50 levels differs by 50 levels, however slowly.
    "slow light": (picture(SINE), "the columns differ by 50 grey levels in all, but within "),
    "one edge": (picture(STEP), "1 steep edge between bright and dark columns; at least 3 are"),
    "two edges": (picture(FLASH), "2 steep edges between bright and dark columns; at least 3"),
    "three edges": (picture(np.concatenate([STEP, STEP])), None),
    "white": (
        picture(WHITE),
        "83 % of the panel's columns are saturated; at most 80 % are allowed",
    ),
    "white all over": (picture(np.full(600, 255.0)), "100 % of the panel's columns are saturated"),
    "less white": (picture(np.where(COLUMNS % 60 < 14, 40.0, 255.0)), None),
    "stripes": (picture(SQUARE, noise=20.0), None),
}


@pytest.mark.parametrize("name", PHOTOS)
def test_why_there_are_no_stripes_is_what_is_seen(name: str) -> None:
    image, said = PHOTOS[name]
    reasons = reasons_of(image)
    assert len(reasons) == (said is not None)
    for reason in reasons:
        assert said in reason


@pytest.mark.parametrize("noise", [30.0, 60.0])
def test_what_rows_have_in_common_is_stated_in_numbers(noise: float) -> None:
    """Rows of slow light vary together: what noise hides is what changes from column to column."""
    image = picture(SINE, noise)
    (reason,) = reasons_of(image)
    stated = re.search(r"only (\d+) % of the changes from column to column", reason)
    assert float(stated[1]) == pytest.approx(common_percent(image), abs=1.0)
    assert reasons_of(picture(SQUARE, 20.0)) == ()


def test_stripes_along_the_other_axis_are_told_where_they_are() -> None:
    image = picture(SQUARE, noise=3.0).T
    *_, told = reasons_of(image)
    repeated = re.search(r"other axis, which repeat after ([\d.]+) rows", told)
    assert float(repeated[1]) == pytest.approx(60.0, abs=0.5)
    assert "with lines as the scan axis" in told
    # A region of it says so, too, and neither one edge nor noise is stripes.
    with pytest.raises(occ.MatchError, match="along the other axis"):
        occ.find_stripes(photo_of(image), (0, 500, 0, 50))
    for other in (picture(STEP).T, picture(np.full(600, 90.0), noise=20.0, rows=200)):
        assert len(reasons_of(other)) == 1


def refused(photo: occ.Photo, scene: occ.Scene, **how: str) -> tuple[str, ...]:
    with pytest.raises(occ.MatchError) as error:
        occ.match_photo(photo, scene, **how)  # type: ignore[arg-type]
    return error.value.reasons


def test_a_period_that_is_not_found_is_told_by_the_best_likeness() -> None:
    lengths = np.random.default_rng(8).integers(8, 60, 30)
    profile = np.repeat(np.resize([40.0, 200.0], 30), lengths)[:600]
    (why,) = refused(photo_of(picture(profile)), occ.Scene(), sent="read")
    stated = re.search(r"by up to (\d+) columns, they correlate .* by ([\d.]+) at most", why)
    stripes = occ.find_stripes(photo_of(picture(profile)))
    longest = int(0.67 * len(stripes.profile))
    assert int(stated[1]) == longest
    light = stripes.flattened - stripes.flattened.mean()
    lags = range(60, longest)
    likeness = [float(np.corrcoef(light[:-lag], light[lag:])[0, 1]) for lag in lags]
    assert float(stated[2]) == pytest.approx(max(likeness), abs=0.1)


KNOWN = occ.load_preset("phone-68us").replace(pattern="10", switching_frequency=2e3)


def chips(pattern: str, columns: int, noise: float) -> occ.Photo:
    """Photograph chips of 50 columns, exposed for seven."""
    sent = np.resize([40.0 + 160.0 * (chip == "1") for chip in pattern], columns // 50 + 2)
    profile = np.convolve(np.repeat(sent, 50), np.ones(7) / 7, mode="same")
    return photo_of(picture(profile[25 : 25 + columns], noise))


def test_the_stripes_of_a_lamp_are_no_chips_that_are_read() -> None:
    photo = chips("10", 250, noise=10.0)
    match = occ.match_photo(photo, KNOWN)
    assert match.readout_time == pytest.approx(1e-5, rel=2e-3)
    assert match.verdict == "doubtful"
    plain, repeated, chance = refused(photo, KNOWN, sent="read")
    assert plain == PLAIN_STRIPES
    assert "They repeat after 100.0 columns and are bright for 50 % of them" in repeated
    assert "explained by a lamp with a duty of 50 % read from the photo than by chance" in chance


def test_chips_that_are_not_read_are_said_to_be_unread(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Candidates, "read", lambda *_: [])
    photo, told = chips("110100", 1500, noise=2.0), KNOWN.replace(pattern="1110001010")
    unread, *_ = refused(photo, told)
    period = re.search(
        r"repeat after ([\d.]+) columns, but no sequence .*; say what is sent", unread
    )
    assert float(period[1]) == pytest.approx(300.0, abs=1.0)
    assert not any("no sequence" in why for why in refused(photo, told, sent="scene"))


def judged(
    left: FloatArray | float = 0.0, profile: FloatArray = SQUARE, row_correlation: float = 1.0,
    sent: str = "110100", blinks: bool = True, **figures: Any,
) -> list[str]:  # fmt: skip
    """Return the refusals of a hypothesis that was read: it leaves noise, and something else."""
    found = hypothesis(
        sent, Timing(len(sent) / 60.0, 0.5, 0.0, 2.2), 600, swing=np.full(600, 160.0),
        profile=profile - left, residual=float(np.sum((NOISE + left) ** 2)), **figures,
    )  # fmt: skip
    ends = np.full(600, profile.min()), np.full(600, profile.max())
    stripes = Stripes(occ.Region(0, 60, 0, 600), profile + NOISE, *ends, 60.0, 0.1, 0.0)
    try:
        Judge(stripes, row_correlation, blinks=blinks).choose([found])
    except occ.MatchError as error:
        return list(error.reasons)
    return []


SHAPE = 20.0 * np.sin(2.0 * np.pi * COLUMNS * 7 / 60.0)  # repeats as the square wave does

JUDGED: dict[str, tuple[dict[str, Any], str | None]] = {
    "all is well": ({}, None),
    "correlation": ({"correlation": 0.899}, "correlation is 0.899; at least 0.900 is needed"),
    "enough correlation": ({"correlation": 0.9}, None),
    "information": ({"information": 29.7}, "by chance by 29.7 bits only; at least 30.0 are needed"),
    "no information": ({"information": -9.0}, "by chance by 0 bits only; at least 30 are needed"),
    "enough information": ({"information": 30.1}, None),
    "rows": ({"row_correlation": 0.698}, "their correlation is 0.698; at least 0.700 is needed"),
    "rows that are alike": ({"row_correlation": 0.7}, None),
    "slow light": (
        {"profile": SINE, "left": SHAPE}, "Light that varies slowly, without any code, explains"),
    "no slow light": ({"left": SHAPE}, None),
    "a wave of another shape": (
        {"blinks": False, "left": SHAPE}, "A wave of another shape that repeats as often"),
    "no other shape": ({"blinks": False}, None),
    "another shape where a lamp blinks": ({"left": SHAPE}, None),
    "plain stripes": ({"blinks": False, "sent": "1100"}, "choose a lamp as what was sent"),
    "plain stripes that are read": ({"sent": "1100"}, "choose a lamp as what was sent"),
}  # fmt: skip


@pytest.mark.parametrize("name", JUDGED)
def test_why_an_explanation_is_refused_is_what_speaks_against_it(name: str) -> None:
    changes, said = JUDGED[name]
    reasons = judged(**changes)
    assert bool(reasons) == (said is not None)
    assert said is None or said in reasons[0]


def test_a_lamp_without_stripes_is_told_by_what_its_columns_differ() -> None:
    image = np.full((120, 300), 16.0)
    image[32:88, 60:240] = 187.0 + np.arange(180) / 30.0
    image = image.astype(np.uint8)
    ((lamp, why),) = occ.match_lamps(photo_of(image), KNOWN)
    assert not lamp.modulated
    rows = image[lamp.region.first_row : lamp.region.last_row]
    inside = rows[:, lamp.region.first_column : lamp.region.last_column].mean(axis=0)
    assert str(why) == (
        f"No stripes were found in it: its {lamp.region.columns} columns differ by "
        f"{np.ptp(inside):.2g} grey levels."
    )


@pytest.mark.parametrize(
    ("runs", "said"),
    [
        ([30] * 4, "3 edges of stripes are in view; at least 5 are needed"),
        (
            [30, 1, 1, 30, 1, 1, 30, 1, 1, 30, 1, 1, 30],
            "stripe have 2.0 columns together; more than 2.8",
        ),
    ],
)
def test_why_no_chips_are_read_is_told(runs: list[int], said: str) -> None:
    profile = np.repeat(np.resize([40.0, 200.0], len(runs)), runs)
    with pytest.raises(occ.MatchError, match=said):
        occ.read_chips(photo_of(picture(profile)))
