"""The command render writes the picture of the camera or of the receiver, and says which."""

from pathlib import Path

import numpy as np
import pytest
from PIL import ExifTags, Image

import occ_model as occ
from occ_model.cli import main
from occ_model.results.frame import PICTURES

SCENE = ("--set", "rows=300")


@pytest.mark.parametrize("whose", PICTURES)
def test_the_picture_asked_for_is_written_and_named(
    tmp_path: Path, whose: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "picture.png"
    assert main(["render", *SCENE, "--picture", whose, "-o", str(path)]) == 0
    frame = occ.render(occ.load_preset("phone-68us").replace(rows=300))
    assert f"{whose}'s picture" in capsys.readouterr().out
    with Image.open(path) as picture:
        assert np.array_equal(np.asarray(picture), frame.picture(whose))
        assert picture.info["Description"] == frame.picture_title(whose)


@pytest.mark.parametrize("ending", ["jpg", "tif", "webp", "bmp"])
def test_other_formats_say_it_by_exif_where_they_can(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"picture.{ending}"
    assert main(["render", *SCENE, "--picture", "camera", "-o", str(path)]) == 0
    with Image.open(path) as picture:
        text = picture.getexif().get(ExifTags.Base.ImageDescription)
    assert text == (None if ending == "bmp" else "Camera's picture")
    assert occ.load_photo(path).image.shape == (300, 3456)
