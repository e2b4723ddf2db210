"""Lenses that fold or bend by any amount, and pictures and blurs that could fill the memory."""

import math
import tracemalloc

import cv2
import mpmath
import numpy as np
import pytest
from hypothesis import strategies as st

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import GEOMETRY, POSES, decades, lenses, poses, signed_decades
from occ_model.camera.optics import Optics
from occ_model.camera.projection import MAX_PIXELS, image_rays
from occ_model.effects.distortion import Distortion, distort, undistort
from occ_model.effects.optics_effects import blur_of
from occ_model.scene.scene import Scene


def opencv_places(rays: np.ndarray, scene: Scene) -> np.ndarray:
    focal, lens, camera = scene.camera.focal_length_pixels, scene.lens, scene.camera
    centre = ((camera.columns - 1) / 2, (camera.rows - 1) / 2)
    matrix = np.array([[focal, 0, centre[0]], [0, focal, centre[1]], [0, 0, 1.0]])
    coefficients = [lens.radial_k1, lens.radial_k2, lens.tangential_p1, lens.tangential_p2]
    points = np.column_stack([rays, np.ones(len(rays))])
    still = np.zeros(3)
    return cv2.projectPoints(points, still, still, matrix, np.array(coefficients))[0][:, 0]


@cases(
    lens=lenses(),
    distance=decades(0.3, 100.0),
    roll=st.floats(-3.0, 3.0),
    yaw=st.floats(-1.0, 1.0),
    focal=decades(0.005, 0.2),
)
def test_the_bent_outline_lies_on_the_curve_that_opencv_projects(
    lens: dict[str, float], distance: float, roll: float, yaw: float, focal: float
) -> None:
    scene = Scene().replace(
        rows=600, columns=800, distance=distance, roll=roll, yaw=yaw,
        equivalent_focal_length=focal, **lens
    )  # fmt: skip
    corners = occ.panel_corners(scene)
    try:
        outline = Distortion().apply(scene, Optics(corners)).outline
    except occ.ProjectionError:
        return
    # Every corner that OpenCV projects into the picture is a corner of the outline,
    rays = image_rays(corners, scene.camera)
    pictured = opencv_places(rays, scene)
    inside = ((pictured >= 0) & (pictured <= [799, 599])).all(axis=1)
    near = np.hypot(*np.abs(rays).T) < 0.5 * math.hypot(600, 800) / scene.camera.focal_length_pixels
    for corner in pictured[inside & near]:
        error = float(np.hypot(*(outline - corner).T).min())
        record("distorted corners against OpenCV, px", "k to 10, p to 1", error, 1e-9)
    # and every edge of it that is in the picture lies along the curve.
    fraction = np.linspace(0, 1, 41)[:, None, None]
    line = rays * (1 - fraction) + np.roll(rays, -1, axis=0) * fraction
    curve = opencv_places(line.reshape(-1, 2), scene)
    reached = np.hypot(*line.reshape(-1, 2).T) * scene.camera.focal_length_pixels < 500
    seen = curve[((curve >= 0) & (curve <= [799, 599])).all(axis=1) & reached]
    if len(seen) == 0:
        return
    following = np.roll(outline, -1, axis=0) - outline
    square = np.maximum((following**2).sum(-1), 1e-300)
    offset = seen[:, None] - outline
    along = np.clip((offset * following).sum(-1) / square, 0, 1)
    missed = offset - along[..., None] * following
    error = float(np.hypot(missed[..., 0], missed[..., 1]).min(axis=1).max())
    record("distorted edges against OpenCV, px", "k to 10, p to 1", error, 0.02)


@cases(lens=lenses(), focal=decades(0.002, 0.2))
def test_a_lens_that_is_not_refused_has_an_exact_inverse_everywhere(
    lens: dict[str, float], focal: float
) -> None:
    scene = Scene().replace(rows=600, columns=800, equivalent_focal_length=focal, **lens)
    row, column = np.mgrid[0:600:23j, 0:800:29j] - 0.5
    points = np.stack([column, row], axis=-1)
    try:
        Distortion().apply(scene, Optics(occ.panel_corners(scene)))
    except occ.ProjectionError:
        with pytest.raises(occ.ProjectionError, match="nearer to 0"):
            undistort(points, scene)
        return
    straight = undistort(points, scene)
    there = opencv_places(image_rays(straight.reshape(-1, 2), scene.camera), scene)
    error = float(np.abs(there - points.reshape(-1, 2)).max())
    record("the inverse of a lens against OpenCV, px", "k to 10, p to 1", error, 1e-9)
    # It is the one before any fold: neighbours in the picture are neighbours without distortion.
    across, down = np.diff(straight, axis=1)[:-1], np.diff(straight, axis=0)[:, :-1]
    area = across[..., 0] * down[..., 1] - across[..., 1] * down[..., 0]
    record("a lens's inverse turned inside out", "k to 10, p to 1", float((area <= 0).any()), 0.0)


@cases(lens=lenses(), x=signed_decades(1e-9, 1e3), y=signed_decades(1e-9, 1e3))
def test_browns_equation_is_that_of_forty_digits(
    lens: dict[str, float], x: float, y: float
) -> None:
    found = distort(np.array([x, y]), Scene().replace(**lens).lens)
    with mpmath.workdps(40):
        k1, k2, p1, p2, u, v = map(mpmath.mpf, (*lens.values(), x, y))
        square = u * u + v * v
        radial = 1 + k1 * square + k2 * square**2
        size = abs(1 + abs(k1) * square + abs(k2) * square**2) * mpmath.sqrt(square)
        size += 3 * (abs(p1) + abs(p2)) * square
        expected = (
            u * radial + 2 * p1 * u * v + p2 * (square + 2 * u * u),
            v * radial + 2 * p2 * u * v + p1 * (square + 2 * v * v),
        )
        error = max(float(abs(e - f) / size) for e, f in zip(expected, found.tolist(), strict=True))
    record("Brown's equation, of its terms", "rays to 1000 focal lengths", error, 2e-15)


@cases(
    scene=poses(),
    lens=lenses(),
    spread=st.just(0.0) | decades(1e-300, 1000.0),
    focus=st.just(0.0) | decades(1e-300, 1e6),
    pattern=st.sampled_from(["1", ""]),
)
def test_any_pose_and_lens_gives_a_picture_or_a_sentence(
    scene: Scene, lens: dict[str, float], spread: float, focus: float, pattern: str
) -> None:
    hard = scene.replace(
        **lens, point_spread=spread, focus_distance=focus, pattern=pattern, illuminance=1.0
    )
    try:
        frame = occ.render(hard, tolerance=0, force=GEOMETRY)
    except occ.ProjectionError as refusal:
        error = 0.0 if str(refusal).endswith(("nearer to 0.", "turn it back.")) else 1.0
    else:
        assert frame.image.shape == (hard.camera.rows, hard.camera.columns)
        finite = np.isfinite(frame.profile).all()
        bounds = all(math.isfinite(decision.estimate) for decision in frame.plan.decisions)
        error = 0.0 if finite and bounds else 1.0
    record("a picture or a sentence, and no number that is none", f"{POSES}, any lens", error, 0.0)


def test_a_fold_between_two_of_the_circles_that_are_searched_is_refused() -> None:
    # It folds at 0.32 focal lengths and turns inside out at 0.55; the corners are at 9.5.
    scene = Scene().replace(rows=600, columns=800, equivalent_focal_length=0.00228, radial_k1=-3.32)
    with pytest.raises(occ.ProjectionError, match="folds the picture"):
        occ.render(scene, tolerance=0, force=GEOMETRY)


HUGE: dict[str, dict[str, int]] = {
    # 1e11 pixels, with each number in its range.
    "the most rows and columns": {"rows": 100_000, "columns": 1_000_000},
    # One row too many.
    "a row too many": {"rows": MAX_PIXELS // 1_000_000 + 1, "columns": 1_000_000},
    "as many columns as rows": {"rows": 100_000, "columns": 100_000},
}


@pytest.mark.parametrize("lens", [{}, {"point_spread": 1000.0, "radial_k1": 0.1}])
@pytest.mark.parametrize("name", HUGE)
def test_a_picture_too_large_for_memory_is_refused_beforehand(
    name: str, lens: dict[str, float]
) -> None:
    scene = Scene().replace(**HUGE[name], **lens)
    tracemalloc.start()
    with pytest.raises(occ.ProjectionError, match=r"million pixels; allowed: up to 170 million\.$"):
        occ.render(scene)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1e6


def test_the_widest_blur_takes_no_more_memory_than_a_narrow_one() -> None:
    # A blur of 1e8 pixels once took a row of numbers for each pixel in its reach.
    scene = Scene().replace(
        rows=2, columns=200_000, focus_distance=0.001, equivalent_focal_length=2.0,
        f_number=0.5, distance=1.2, pattern="1", pixel_pitch=1e-4,
    )  # fmt: skip
    assert blur_of(scene) > 1e8
    tracemalloc.start()
    frame = occ.render(scene, tolerance=0, force=GEOMETRY)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert np.isfinite(frame.profile).all()
    assert peak < 100e6
