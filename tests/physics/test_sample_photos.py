"""The sample photos are the model's own, say so, and give their scenes back."""

from io import BytesIO

import numpy as np
import pytest
from PIL import Image
from sample_photos import FOLDER, KNOWN, QUALITY, SCENES, as_jpeg, taken

import occ_model as occ

NAMES = sorted(SCENES)


@pytest.mark.parametrize("name", NAMES)
def test_the_scene_beside_a_sample_is_the_one_it_shows(name: str) -> None:
    beside = occ.Scene.from_toml((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    assert beside == SCENES[name]
    with Image.open(FOLDER / f"{name}.jpg") as opened:
        kept = np.asarray(opened).astype(float)
    simulated = taken(SCENES[name]).astype(float)
    assert kept.shape == simulated.shape
    # As far apart as compression leaves them, and no further.
    again = np.asarray(Image.open(BytesIO(as_jpeg(SCENES[name])))).astype(float)
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
        assert opened.getexif()[0x010E] == KNOWN
    photo, camera = occ.load_photo(path), SCENES[name].camera
    assert photo.camera.startswith("Simulated")
    assert photo.exposure_time == pytest.approx(camera.exposure_time, rel=1e-3)
    assert photo.f_number == pytest.approx(camera.f_number, rel=1e-3)


@pytest.mark.parametrize("name", NAMES)
def test_a_sample_is_matched_by_its_scene(name: str) -> None:
    camera = SCENES[name].camera
    match = occ.match_photo(
        occ.load_photo(FOLDER / f"{name}.jpg"), SCENES[name].replace(readout_time=1e-6)
    )
    assert match.readout_time == pytest.approx(camera.readout_time, rel=1e-3)
    # Not nearer: exposures of 5 and 15 columns are partly alike to the blur of a lens, which the
    # match does not know. What it states holds that, and it must stay within it.
    off = abs(match.exposure_time - camera.exposure_time)
    assert off < 3.0 * match.uncertainties["exposure_time"]
    if camera.exposure_time > 12.0 * camera.readout_time:
        assert off < 0.05 * camera.exposure_time
    assert match.correlation > 0.98


def test_the_code_of_a_sample_is_read_without_being_given() -> None:
    match = occ.match_photo(
        occ.load_photo(FOLDER / "packets-6khz.jpg"),
        occ.load_preset("phone-136us").replace(switching_frequency=6e3),
    )
    assert match.scene.transmitter.code == SCENES["packets-6khz"].transmitter.code
