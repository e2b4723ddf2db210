"""Photos of three colours, and RAW files read line by line without demosaicing."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from raw_files import PATTERNS, write_dng

import occ_model as occ
from occ_model.camera.photometry import panel_values
from occ_model.effects.effect import paper_view_of
from occ_model.photo.reading.colours import load_colours
from occ_model.scene.colour_scenes import led_scene
from occ_model.scene.scene import Scene

LINES, COLUMNS = 1200, 160


def scene_of(**changes: float | str) -> Scene:
    scene = occ.load_preset("phone-68us-colour")
    return scene.replace(rows=COLUMNS, columns=LINES, panel_width=9.0, panel_height=9.0, **changes)


def photosites(scene: Scene, pattern: str) -> np.ndarray:
    """Let a sensor of 16 bits see three codes, shape (lines, columns)."""
    views = [paper_view_of(led_scene(scene, index)) for index in range(3)]
    lit = np.array(scene.colours.matrix) @ np.array([view.light.lit for view in views])
    colours = np.frombuffer(PATTERNS[pattern], np.uint8).reshape(2, 2)
    lines, columns = np.arange(LINES)[:, None], np.arange(COLUMNS)[None, :]
    light = 0.04 + 0.7 * lit[colours[lines % 2, columns % 2], lines]
    assert panel_values(views[0].scene, views[0].light).shape == (LINES,)
    return np.rint(65535 * light).astype(np.uint16)


@pytest.mark.parametrize("pattern", PATTERNS)
def test_three_codes_are_read_from_photosites_of_any_pattern(tmp_path: Path, pattern: str) -> None:
    scene = scene_of()
    path = write_dng(tmp_path / "x.dng", photosites(scene, pattern), pattern)
    photo = load_colours(path, gamma=scene.camera.gamma)
    across = {"rggb": "rggb", "grbg": "gbrg", "gbrg": "grbg", "bggr": "bggr"}
    assert photo.bayer == across[pattern.lower()]
    assert photo.image.shape == (COLUMNS, LINES)
    for decoder in ("threshold", "matched"):
        reading = occ.decode_colours(photo.image, scene.replace(bayer=photo.bayer), decoder)
        assert str(reading) == "red 718, green 345, blue 201"


def test_photosites_keep_their_light(tmp_path: Path) -> None:
    raw = np.random.default_rng(2).integers(0, 65536, (40, 60)).astype(np.uint16)
    photo = load_colours(write_dng(tmp_path / "x.dng", raw), gamma=1.0, scan_axis="columns")
    assert np.array_equal(photo.image, np.rint(raw / 257.0).astype(np.uint8))


def test_a_picture_keeps_its_channels_and_a_grey_one_is_a_mosaic(tmp_path: Path) -> None:
    rgb = np.random.default_rng(4).integers(0, 256, (30, 50, 3), dtype=np.uint8)
    Image.fromarray(rgb).save(tmp_path / "x.png")
    Image.fromarray(rgb[:, :, 0]).save(tmp_path / "grey.png")
    assert np.array_equal(load_colours(tmp_path / "x.png", gamma=2.2).image, rgb)
    turned = load_colours(tmp_path / "x.png", gamma=2.2, scan_axis="lines").image
    assert np.array_equal(turned, rgb.transpose(1, 0, 2))
    assert np.array_equal(load_colours(tmp_path / "grey.png", gamma=2.2).image, rgb[:, :, 0])
