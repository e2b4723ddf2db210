"""What a photo's match costs."""

from functools import cache
from pathlib import Path

import cv2
from measuring import Row, side_by_side

import occ_model as occ
from occ_model.scene.scene import Scene

_ROWS, _COLUMNS = 3024, 4032


@cache
def _photo() -> tuple[occ.Photo, Scene]:
    """Take a photo of 12 million pixels, and say what is known of it."""
    scene = occ.load_preset("phone-136us-real").replace(
        rows=_ROWS, columns=_COLUMNS, switching_frequency=6e3, enhancement="none"
    )
    image = occ.render(scene, tolerance=0.0).image
    photo = occ.Photo(
        path=Path("simulated.png"), samples=image, white=255, image=image,
        profile=image.mean(axis=0), turned=False, channel="grey",
    )  # fmt: skip
    return photo, scene.replace(readout_time=1e-6, exposure_time=1e-3)


def match_cost() -> Row:
    """Compare matching a photo with a mean of its columns."""
    photo, scene = _photo()
    a, b, stripes = side_by_side(
        lambda: occ.match_photo(photo, scene),
        lambda: cv2.reduce(photo.image, 0, cv2.REDUCE_AVG, dtype=cv2.CV_32F),
        lambda: occ.find_stripes(photo),
        rounds=5,
    )
    return Row(
        "matching a photo of 12 million pixels, against one mean of its columns",
        f"{a / b:.0f} ({1e3 * a:.0f} ms; finding its stripes {1e3 * stripes:.0f} ms)",
        "under 1 s",
    )


def reading_cost() -> Row:
    """Compare matching a photo of unknown chips with one of known chips."""
    photo, scene = _photo()
    other = scene.replace(code=(scene.transmitter.code + 1) % 1024)
    a, b = side_by_side(
        lambda: occ.match_photo(photo, other), lambda: occ.match_photo(photo, scene), rounds=5
    )
    return Row(
        "the same with another code in the scene, so that its chips are read, against known chips",
        f"{a / b:.1f} ({1e3 * a:.0f} ms)",
        "under 1 s",
    )
