"""A picture is linear where its file says so, and nowhere else."""

import struct
from pathlib import Path

import numpy as np
import pytest
from photo_files import PICTURE, png, png_chunk, save
from PIL import ImageCms
from pillow_heif import from_pillow

from occ_model.photo.reading.load import load_photo

STRAIGHT = (
    b"curv\0\0\0\0" + struct.pack(">L", 0),
    b"curv\0\0\0\0" + struct.pack(">LH", 1, 256),
    b"para\0\0\0\0" + struct.pack(">HxxL", 0, 65536),
)
BENT = (
    b"curv\0\0\0\0" + struct.pack(">LH", 1, 563),
    b"curv\0\0\0\0" + struct.pack(">LHHH", 3, 0, 9000, 65535),
    b"para\0\0\0\0" + struct.pack(">HxxL", 0, 144179),
    b"para\0\0\0\0" + struct.pack(">HxxL5L", 3, 65536, 1, 1, 1, 1, 1),
    b"curv",
)


def profile(curve: bytes) -> bytes:
    return bytes(128) + struct.pack(">L4sLL", 1, b"kTRC", 144, len(curve)) + curve


@pytest.mark.parametrize("curve", STRAIGHT + BENT)
@pytest.mark.parametrize("ending", [".png", ".tif", ".jpg", ".avif"])
def test_a_profile_with_straight_curves_is_linear(
    tmp_path: Path, ending: str, curve: bytes
) -> None:
    path = save(tmp_path, PICTURE, f"x{ending}", icc_profile=profile(curve))
    assert load_photo(path).is_linear is (curve in STRAIGHT)


def test_the_usual_profile_is_not_linear(tmp_path: Path) -> None:
    usual = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    assert not load_photo(save(tmp_path, PICTURE, icc_profile=usual)).is_linear
    assert not load_photo(save(tmp_path, PICTURE)).is_linear


@pytest.mark.parametrize(
    ("gamma", "more", "is_linear"),
    [
        (100_000, b"", True),
        (45_455, b"", False),
        (100_000, png_chunk(b"sRGB", b"\0"), False),
    ],
)
def test_a_png_without_gamma_correction_is_linear(
    tmp_path: Path, gamma: int, more: bytes, is_linear: bool
) -> None:
    chunks = png_chunk(b"gAMA", struct.pack(">L", gamma)) + more
    (tmp_path / "x.png").write_bytes(png(20, 20, more=chunks))
    assert load_photo(tmp_path / "x.png").is_linear is is_linear


@pytest.mark.parametrize(("transfer", "is_linear"), [(8, True), (13, False), (16, False)])
def test_a_heic_says_its_transfer(tmp_path: Path, transfer: int, is_linear: bool) -> None:
    path = tmp_path / "x.heic"
    from_pillow(PICTURE).save(path, transfer_characteristics=transfer)
    assert load_photo(path).is_linear is is_linear
    assert np.abs(load_photo(path).image.astype(float) - np.asarray(PICTURE)).max() <= 12
