"""Laws of a picture in a JPEG file, compared with files that OpenCV writes."""

import io

import cv2
import numpy as np
import pytest
from physics.effect_world import rms
from PIL import Image

import occ_model as occ
from occ_model.effects.sensor_effects import Jpeg, quantization_steps
from occ_model.scene.scene import Scene


def scene_at_quality(quality: int) -> Scene:
    return Scene().replace(jpeg_quality=quality)


def steps_in_file(quality: int) -> np.ndarray:
    """Read the steps from a file that OpenCV writes, shape (8, 8)."""
    written = cv2.imencode(".jpg", np.zeros((8, 8), np.uint8), [cv2.IMWRITE_JPEG_QUALITY, quality])
    with Image.open(io.BytesIO(written[1].tobytes())) as picture:
        table = list(picture.quantization[0])  # type: ignore[attr-defined]
    assert len(table) == 64
    return np.array(table).reshape(8, 8)


def test_the_steps_are_those_in_the_file() -> None:
    for quality in range(1, 101):
        np.testing.assert_array_equal(quantization_steps(quality), steps_in_file(quality))


def test_a_better_quality_changes_less() -> None:
    picture = np.random.default_rng(2).integers(0, 256, (160, 160), dtype=np.uint8)
    changes = [
        rms(Jpeg().apply(scene_at_quality(quality), picture) - picture.astype(float))
        for quality in (5, 20, 50, 80, 95, 100)
    ]
    assert (np.diff(changes) < 0).all()
    assert changes[-1] < 1.0


def test_the_picture_is_the_files_and_enhanced_after_it() -> None:
    scene = scene_at_quality(30).replace(rows=60, columns=200, distance=0.05)
    only = {"sensor-noise": False, "fixed-pattern": False}
    plain = occ.render(scene.replace(enhancement="none"), tolerance=0, force=only)
    sharp = occ.render(scene.replace(enhancement="none", jpeg_quality=0), force=only)
    np.testing.assert_array_equal(plain.image, Jpeg().apply(scene, sharp.image))
    np.testing.assert_allclose(plain.profile, plain.image.mean(axis=0), atol=1e-9)
    equalized = occ.render(scene, tolerance=0, force=only).image
    # A grey level of the file always becomes the same enhanced level, in the same order.
    for level in np.unique(plain.image):
        assert len(np.unique(equalized[plain.image == level])) == 1
    order = np.argsort(plain.image, axis=None)
    assert (np.diff(equalized.ravel()[order].astype(int)) >= 0).all()


def test_a_picture_too_large_for_a_file_is_refused() -> None:
    scene = scene_at_quality(80).replace(rows=1, columns=70_000)
    with pytest.raises(occ.ParameterError, match="jpeg_quality"):
        occ.render(scene, tolerance=0)
