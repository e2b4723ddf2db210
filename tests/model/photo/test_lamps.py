"""Several lamps in one photo: each is found, with its frequency, and matched by itself."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from amount import amount
from matches import match_with
from photo_world.hot_lamps import hot_lamp_scene
from photo_world.lamp_scores import score_of
from simulated_photos import photo_of

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.cli import main
from occ_model.commands import match
from occ_model.files.writing import write_image
from occ_model.photo.lamps import match as lamps_match
from occ_model.photo.lamps.blinking import Blinking
from occ_model.photo.lamps.find import may_be_miscounted
from occ_model.scene.scene import Scene

ROWS, COLUMNS = 240, 720


def stripes(period: float, phase: float = 0.0, duty: float = 0.5) -> np.ndarray:
    """One row of stripes of an LED that is on for a fraction of each period, blurred a little."""
    fine = (np.arange(8 * COLUMNS) / 8 + phase) / period % 1.0 < duty
    return np.convolve(fine.reshape(-1, 8).mean(axis=1), np.ones(3) / 3, mode="same")


def picture(*lamps: tuple[tuple[int, int, int, int], float, float, float]) -> ByteArray:
    """Draw lamps (rows and columns, level, period, phase) on a dark, noisy wall."""
    noise = np.random.default_rng(1).normal(0.0, 2.0, (ROWS, COLUMNS))
    image = 12.0 + noise
    for (top, bottom, left, right), level, period, phase in lamps:
        row = stripes(period, phase) if period else np.ones(COLUMNS)
        image[top:bottom, left:right] += level * row[left:right]
    return np.clip(np.rint(image), 0, 255).astype(np.uint8)


def products(image: ByteArray) -> list[float]:
    found = [lamp.switching_frequency_times_readout for lamp in occ.find_lamps(photo_of(image))]
    return [product for product in found if product is not None]


def test_nearly_all_lamps_of_a_simulated_scene_are_found() -> None:
    """Of one scene; ``tests/benchmarks/matching.py lamps`` tries 200."""
    score = score_of([2000])
    assert score.found >= 0.9 * score.there
    assert score.right >= 0.9 * score.there
    assert score.invented <= 0.05 * score.reported + 1


def test_most_lamps_with_hot_spots_and_halos_are_found_and_none_with_a_wrong_frequency() -> None:
    """Of a scene; ``tests/benchmarks/matching.py hot-lamps`` tries 200."""
    score = score_of(range(72000, 72000 + amount(1, 2)), hot_lamp_scene)
    # Of 102 lamps that the search was made with 84 % are found: three deviations less of so few.
    assert score.found >= 0.84 * score.there - 3.0 * (0.84 * 0.16 * score.there) ** 0.5
    assert score.surely_wrong == 0
    assert score.invented <= 0.05 * score.reported + 1


@pytest.mark.parametrize(
    "second", [(120, 220, 100, 400), (20, 120, 400, 700)], ids=["below", "beside"]
)
def test_lamps_that_touch_are_two(second: tuple[int, int, int, int]) -> None:
    image = picture(((20, 120, 100, 400), 200.0, 30.0, 3.0), (second, 150.0, 41.0, 11.0))
    assert products(image) == pytest.approx([2 / 30.0, 2 / 41.0], rel=0.01)


def test_the_brightest_lamp_is_first() -> None:
    image = picture(((20, 80, 50, 350), 120.0, 30.0, 0.0), ((120, 200, 380, 690), 220.0, 37.0, 0.0))
    assert products(image) == pytest.approx([2 / 37.0, 2 / 30.0], rel=0.01)


def test_a_fainter_place_in_time_with_a_lamp_is_its_reflection() -> None:
    lamp, faint = (20, 100, 50, 350), (130, 220, 380, 690)
    image = picture((lamp, 220.0, 30.0, 5.0), (faint, 60.0, 30.0, 5.0))
    (found,) = occ.find_lamps(photo_of(image))
    (mirrored,) = found.reflections
    assert mirrored.first_column == pytest.approx(faint[2], abs=16)
    image = picture((lamp, 220.0, 30.0, 5.0), (faint, 60.0, 30.0, 15.0))
    assert len(occ.find_lamps(photo_of(image))) == 2


@pytest.mark.parametrize(("level", "doubtful"), [(60.0, True), (180.0, False)])
def test_what_is_faint_beside_the_brightest_is_doubtful(level: float, doubtful: bool) -> None:
    lamp, other = (20, 100, 50, 350), (130, 220, 380, 690)
    image = picture((lamp, 220.0, 30.0, 5.0), (other, level, 37.0, 5.0))
    brightest, second = occ.find_lamps(photo_of(image))
    assert not brightest.is_doubtful
    assert second.is_doubtful == doubtful
    assert not any("periods" in doubt for doubt in second.doubts)


def test_a_repeated_part_of_a_code_is_its_reflection() -> None:
    code = np.repeat([1, 1, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1], 16)
    image = np.full((ROWS, COLUMNS), 12.0)
    image[20:120, 40:360] += 200.0 * code
    # Stripes of two chips, at places of the code's lattices.
    image[140:220, 440:600] += 50.0 * np.repeat([0, 1] * 5, 16)
    image += np.random.default_rng(2).normal(0.0, 2.0, image.shape)
    (lamp,) = occ.find_lamps(photo_of(np.clip(image, 0, 255).astype(np.uint8)))
    assert lamp.period is None
    assert len(lamp.reflections) == 1


def test_stripes_that_the_rim_cuts_belong_to_the_lamp() -> None:
    image = 12.0 + np.random.default_rng(3).normal(0.0, 2.0, (ROWS, COLUMNS))
    # The rim takes light from the outer stripes, and shifts their inner edges by 0.13 of a chip.
    for left, right, level in ((141, 159, 160), (206, 269, 220), (307, 372, 220), (415, 453, 180)):
        image[40:200, left:right] += level
    (lamp,) = occ.find_lamps(photo_of(np.clip(image, 0, 255).astype(np.uint8)))
    assert lamp.region.first_column == pytest.approx(141, abs=3)
    assert lamp.region.last_column == pytest.approx(453, abs=3)


def test_a_lamp_of_constant_light_is_not_modulated() -> None:
    image = picture(((20, 100, 50, 350), 220.0, 30.0, 5.0), ((140, 200, 420, 520), 230.0, 0.0, 0.0))
    kinds = {lamp.modulated: lamp for lamp in occ.find_lamps(photo_of(image))}
    assert kinds[False].region.first_column == pytest.approx(420, abs=4)
    assert kinds[False].switching_frequency_times_readout is None


def test_two_panes_side_by_side_are_no_stripes() -> None:
    image = picture(((40, 200, 100, 250), 220.0, 0.0, 0.0), ((40, 200, 270, 420), 220.0, 0.0, 0.0))
    assert products(image) == []


@pytest.mark.parametrize(("periods", "doubtful"), [(2.3, True), (6.0, False)])
def test_stripes_that_repeat_about_twice_are_doubtful(periods: float, doubtful: bool) -> None:
    right = 100 + round(periods * 60)
    (lamp,) = occ.find_lamps(photo_of(picture(((40, 200, 100, right), 200.0, 60.0, 35.0))))
    assert lamp.is_doubtful == doubtful


@pytest.mark.parametrize("seed", range(3))
def test_noise_has_no_lamps(seed: int) -> None:
    noise = np.random.default_rng(seed).normal(60.0, 25.0, (400, 900))
    assert occ.find_lamps(photo_of(np.clip(noise, 0, 255).astype(np.uint8))) == ()


def test_a_round_lamps_columns_are_alike_bright() -> None:
    rows, columns = np.mgrid[0:ROWS, 0:COLUMNS]
    disc = (rows - 120) ** 2 + (columns - 300) ** 2 < 110**2
    image = np.where(disc, 200 * stripes(24.0)[None, :], 0.0) + 12
    photo = photo_of(image.astype(np.uint8))
    (lamp,) = occ.find_lamps(photo)
    assert lamp.area == pytest.approx(disc.sum(), rel=0.1)
    profile = occ.find_stripes(photo, lamp).profile
    assert profile[:40].max() == pytest.approx(profile.max(), rel=0.1)
    assert lamp.covers(120, 300)
    assert not lamp.covers(20, 200)


def test_a_search_goes_from_nothing_to_all_and_ends_by_what_progress_raises() -> None:
    fractions: list[float] = []

    def stop(fraction: float) -> None:
        fractions.append(fraction)
        if fraction > 0.3:
            raise InterruptedError

    image = picture(((20, 120, 100, 400), 200.0, 30.0, 3.0))
    with pytest.raises(InterruptedError):
        occ.find_lamps(photo_of(image), stop)
    assert fractions[-1] < 0.5
    fractions.clear()
    occ.find_lamps(photo_of(image), fractions.append)
    assert fractions == sorted(fractions)
    assert (fractions[0], fractions[-1]) == (0.0, 1.0)


def test_every_lamp_is_matched_by_itself_and_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked: list[Any] = []

    def matched(*_: object, region: Any, **__: object) -> occ.Match:
        asked.append(region)
        if len(asked) == 2:
            raise occ.MatchError("It is not explained.")
        return match_with()

    monkeypatch.setattr(lamps_match, "match_photo", matched)
    monkeypatch.setattr(match, "match_photo", matched)
    path = tmp_path / "lamps.png"
    write_image(
        path,
        picture(
            ((20, 120, 100, 400), 200.0, 30.0, 3.0), ((120, 220, 100, 400), 150.0, 41.0, 11.0),
            ((150, 220, 460, 560), 230.0, 0.0, 0.0),
        ),
    )  # fmt: skip
    command = ["match", str(path), "--led-frequency", "1kHz"]
    assert main([*command, "--lamps"]) == 0
    said = capsys.readouterr().out
    assert [f"lamp {number}: " in said for number in (1, 2, 3, 4)] == [True] * 3 + [False]
    assert "readout_time" in said
    assert "It is not explained." in said
    assert "No stripes were found in it: its 101 columns differ by" in said
    regions = [where.region for where in asked if isinstance(where, occ.Lamp)]
    fractions: list[float] = []
    photo = occ.load_photo(path, "columns")
    found = [lamp for lamp, _ in occ.match_lamps(photo, Scene(), progress=fractions.append)]
    assert regions == [lamp.region for lamp in found if lamp.modulated]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    assert main([*command, "--region", "20:120"]) != 0
    assert "R0:R1,C0:C1" in capsys.readouterr().err
    assert main([*command, "--region", "20:120,100:400"]) == 0
    assert asked[-1] == occ.Region(20, 120, 100, 400)


@pytest.mark.parametrize(("period", "expected"), [(40.0, True), (20.0, False), (10.0, True)])
def test_faint_stripes_that_repeat_otherwise_than_counted_are_doubtful(
    period: float, expected: bool
) -> None:
    lamp = occ.Lamp(occ.Region(0, 8, 0, 400), np.array([[0, 8, 0, 400]]), 200.0, True, period)
    means = np.tile(100.0 + 50.0 * np.sin(np.arange(400) * 2.0 * np.pi / 20.0), (8, 1))
    timing: Any = None
    assert may_be_miscounted(Blinking(lamp, timing, light=0.8, dark=0.2), means) is expected


@pytest.mark.parametrize(("error", "doubtful"), [(0.0033, False), (0.0034, True)])
def test_a_frequency_that_may_be_off_by_a_percent_is_doubtful(error: float, doubtful: bool) -> None:
    (lamp,) = occ.find_lamps(photo_of(picture(((20, 100, 50, 350), 220.0, 30.0, 5.0))))
    product = lamp.switching_frequency_times_readout
    unsure = replace(lamp, product_uncertainty=error * product)
    assert unsure.is_doubtful == doubtful
    assert any("only to 0.34 %" in why for why in unsure.doubts) == doubtful
