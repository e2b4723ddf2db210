"""Sure results hold for photographs from outside the model: samples, cameras, lamps."""

from io import BytesIO

import numpy as np
import pytest
from amount import amount
from photo_world.foreign import foreign
from photo_world.hot_lamps import hot_lamps
from photo_world.trials import foreign_trial_of, hot_trial_of
from PIL import Image
from PIL.ExifTags import Base
from sample_photos import DESCRIPTION, FOLDER, QUALITY, SCENES, encode_as_jpeg, take_photo

import occ_model as occ

NAMES = sorted(SCENES)


@pytest.mark.parametrize("name", NAMES)
def test_the_scene_beside_a_sample_is_the_one_it_shows(name: str) -> None:
    beside = occ.Scene.from_toml((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    assert beside == SCENES[name]
    with Image.open(FOLDER / f"{name}.jpg") as opened:
        kept = np.asarray(opened).astype(float)
    simulated = take_photo(SCENES[name]).astype(float)
    assert kept.shape == simulated.shape
    # They differ by compression, and no more.
    again = np.asarray(Image.open(BytesIO(encode_as_jpeg(SCENES[name])))).astype(float)
    loss = np.sqrt(np.mean((again - simulated) ** 2))
    assert np.sqrt(np.mean((kept - simulated) ** 2)) < 1.2 * loss + 0.2
    assert SCENES[name].camera.jpeg_quality == QUALITY


def test_every_sample_has_its_scene_and_no_other_file_lies_there() -> None:
    there = sorted(path.name for path in FOLDER.iterdir())
    assert there == sorted(f"{name}{ending}" for name in NAMES for ending in (".jpg", ".toml"))


@pytest.mark.parametrize("name", NAMES)
def test_a_sample_says_that_it_is_simulated_and_how_it_was_taken(name: str) -> None:
    path = FOLDER / f"{name}.jpg"
    with Image.open(path) as opened:
        assert opened.getexif()[Base.ImageDescription] == DESCRIPTION
    photo, camera = occ.load_photo(path), SCENES[name].camera
    assert photo.camera.startswith("Simulated")
    assert photo.exposure_time == pytest.approx(camera.exposure_time, rel=1e-3)
    assert photo.f_number == pytest.approx(camera.f_number, rel=1e-3)


@pytest.mark.parametrize("seed", [91000, 91001, 91007])
def test_a_photographs_stripes_repeat_after_the_period_of_its_true_chips(seed: int) -> None:
    """A truth that is wrong by half a column a period would be found."""
    drawn = foreign(seed)
    profile = drawn.image.mean(axis=0)
    columns = np.arange(len(profile))
    period = len(drawn.chips) * drawn.chip
    several = int(0.6 * len(profile) / period)

    def repeats(by: float) -> float:
        later = np.interp(columns + several * by, columns, profile)
        inner = columns + several * by < len(profile) - 1
        return float(np.corrcoef(profile[inner], later[inner])[0, 1])

    tried = period * (1.0 + np.linspace(-0.02, 0.02, 41))
    best = tried[np.argmax([repeats(one) for one in tried])]
    assert several * abs(best - period) < 1.0


@pytest.mark.whole
@pytest.mark.parametrize(
    ("seed", "doubts"),
    # No lamp blurs so much, so that is doubted, although the readout time is right.
    [
        (
            91003,
            [
                "The stripes are blurred over 1.14 columns, as a lens blurs the edges of objects; "
                "those of a lamp are blurred over 0.85 at most."
            ],
        ),
        (91005, []),
    ],
)
def test_a_readout_time_is_within_four_stated_deviations(seed: int, doubts: list[str]) -> None:
    found = foreign_trial_of(seed)
    assert list(found.doubts) == doubts
    assert abs(found.readout_error) < 4.0 * found.readout_deviation
    assert found.readout_deviation < 1e-3


def test_a_picture_shows_what_its_truth_says() -> None:
    """In the lamp's rows a square wave's strongest frequency is one cycle each two chips."""
    for seed in range(100, amount(105, 110)):
        drawn = hot_lamps(seed)
        (sent,), (lamp,) = drawn.sent, drawn.lamps
        if sent.chips != "10" or sent.pauses or drawn.exposure > sent.chip:
            continue
        rows = slice(round(lamp.row) - 8, round(lamp.row) + 8)
        columns = slice(max(0, round(lamp.box[2]) + 5), round(lamp.box[3]) - 5)
        line = drawn.image[rows, columns].mean(axis=0)
        tone = np.hanning(len(line)) * (line - line.mean())
        cycles = np.fft.rfftfreq(16 * len(line))
        power = np.abs(np.fft.rfft(tone, 16 * len(line)))
        fast = cycles > 3.0 / len(line)
        found = cycles[fast][power[fast].argmax()]
        assert found == pytest.approx(0.5 / sent.chip, abs=1.0 / len(line))


@pytest.mark.whole
def test_no_lamp_is_surely_wrong() -> None:
    sure = [one for one in map(hot_trial_of, range(100, 110)) if one.is_sure]
    assert sure
    assert [one.seed for one in sure if abs(one.readout_error) > 0.01] == []
    assert [one.seed for one in sure if one.readout_deviation > 0.03] == []
