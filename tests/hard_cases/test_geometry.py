"""Panels in hard poses are pictured pixel by pixel, or refused with a sentence."""

import math
from itertools import product

import mpmath
import numpy as np
import pytest
from each_case import each_case

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import POSES, SMALL, STEEP, poses
from occ_model.camera.projection import image_rays
from occ_model.scene.scene import Scene


class ExactView:
    """The panel in a pinhole camera, in forty digits."""

    def __init__(self, scene: Scene) -> None:
        with mpmath.workdps(40):
            pose, camera = scene.pose, scene.camera
            angles = [mpmath.mpf(a) for a in (pose.pitch, pose.yaw, pose.roll)]
            (sx, cx), (sy, cy), (sz, cz) = ((mpmath.sin(a), mpmath.cos(a)) for a in angles)
            about_x = mpmath.matrix([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
            about_y = mpmath.matrix([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
            about_z = mpmath.matrix([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
            self.turn = about_z * about_y * about_x
            self.place = mpmath.matrix([pose.offset_x, pose.offset_y, pose.distance])
            self.half = (
                mpmath.mpf(scene.transmitter.panel_width) / 2,
                mpmath.mpf(scene.transmitter.panel_height) / 2,
            )
            self.focal = mpmath.mpf(camera.focal_length_pixels)
            self.centre = (mpmath.mpf(camera.columns - 1) / 2, mpmath.mpf(camera.rows - 1) / 2)

    def corners(self) -> list[tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]]:
        """Return column, row and depth of each corner; a corner not in front of the camera has no
        place."""
        found = []
        with mpmath.workdps(40):
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                at = self.turn * mpmath.matrix([x * self.half[0], y * self.half[1], 0]) + self.place
                depth = at[2] if at[2] else mpmath.mpf("1e-300")
                u, v = (self.focal * at[axis] / depth + self.centre[axis] for axis in (0, 1))
                found.append((u, v, at[2]))
        return found

    def shows(self, column: mpmath.mpf, row: mpmath.mpf) -> bool:
        """Return whether the ray of a point in the picture meets the panel."""
        with mpmath.workdps(40):
            x = (column - self.centre[0]) / self.focal
            y = (row - self.centre[1]) / self.focal
            ray = mpmath.matrix([x, y, 1])
            normal = self.turn[:, 2]
            along = mpmath.fdot(normal, ray)
            if along == 0:
                return False
            times = mpmath.fdot(normal, self.place) / along
            if times <= 0:
                return False
            off = ray * times - self.place
            return all(
                abs(mpmath.fdot(self.turn[:, axis], off)) <= self.half[axis] for axis in (0, 1)
            )

    def distance_from_rim(self, column: int, row: int) -> float:
        """Return how far, to a factor of ten in pixels, a pixel is from the other side of the
        rim."""
        is_in = self.shows(mpmath.mpf(column), mpmath.mpf(row))
        for power in range(-16, 3):
            step = mpmath.mpf(10) ** power
            for down, right in product((-1, 0, 1), repeat=2):
                if self.shows(column + right * step, row + down * step) != is_in:
                    return float(step)
        return math.inf


def rays_meet(scene: Scene) -> np.ndarray:
    """Return which pixels' rays meet the panel, in floating point, shape (rows, columns)."""
    view = ExactView(scene)
    turn = np.array(view.turn.tolist(), dtype=float)
    place = np.array(view.place.tolist(), dtype=float)[:, 0]
    row, column = np.mgrid[0 : scene.camera.rows, 0 : scene.camera.columns].astype(float)
    rays = np.ones((*row.shape, 3))
    rays[..., :2] = image_rays(np.stack([column, row], axis=-1), scene.camera)
    along = rays @ turn[:, 2]
    times = turn[:, 2] @ place / np.where(along == 0.0, np.nan, along)
    off = rays * times[..., None] - place
    half = np.array([float(side) for side in view.half])
    meets: np.ndarray = (np.abs(off @ turn[:, :2]) <= half).all(axis=-1) & (times > 0.0)
    return meets


def misjudged_by(scene: Scene, seen: np.ndarray) -> float:
    """Return the largest distance from the panel's rim, in pixels, of a wrong pixel."""
    view, worst = ExactView(scene), 0.0
    for row, column in np.argwhere(seen != rays_meet(scene)):
        if view.shows(mpmath.mpf(int(column)), mpmath.mpf(int(row))) != seen[row, column]:
            worst = max(worst, view.distance_from_rim(int(column), int(row)))
    return worst


@cases(scene=poses())
def test_corners_are_where_forty_digits_put_them(scene: Scene) -> None:
    exact = ExactView(scene).corners()
    depths = [float(depth) for *_, depth in exact]
    pose, panel = scene.pose, scene.transmitter
    reach = pose.distance + panel.panel_width + panel.panel_height
    try:
        found = occ.panel_corners(scene)
    except occ.ProjectionError:
        # No panel that is clearly in front of the camera may be refused.
        assert min(depths) <= 1e-6 * pose.distance + 1e-15 * reach
        return
    worst = 0.0
    for (u, v, depth), corner in zip(exact, found.tolist(), strict=True):
        # A very small depth is a difference, which loses as many digits of the place.
        size = scene.camera.focal_length_pixels * 2 * reach / float(depth) + scene.camera.columns
        off = max(abs(float(u - corner[0])), abs(float(v - corner[1])))
        worst = max(worst, off / size * (float(depth) / reach))
    record("corners, of the panel's reach", POSES, worst, 2e-15)


@cases(scene=poses())
def test_a_pixel_shows_the_panel_just_where_its_ray_meets_it(scene: Scene) -> None:
    try:
        seen = occ.render(scene, tolerance=math.inf).image > 0
    except occ.ProjectionError:
        return  # whether it may be refused is tested with the corners
    error = misjudged_by(scene, seen)
    record("rim of the panel against each pixel's ray, px", POSES, error, 1e-3)


PICTURED: dict[str, dict[str, float]] = {
    # The picture shows a thousandth of it, with corners a thousand pictures away.
    "a thousand times the picture": {"distance": 0.001, "panel_width": 1.0, "panel_height": 1.0},
    # The same turned and tilted, with edges between corners 1e4 pixels away.
    "a thousand times the picture, turned": {
        "distance": 0.001, "panel_width": 1.0, "panel_height": 1.0, "roll": 0.7},
    # Less than a pixel, between the four central ones: no pixel's centre lies on it.
    "smaller than a pixel": {"distance": 1e4, "panel_width": 1.0, "panel_height": 1.0},
    # Equally small, on a pixel's centre: only that pixel shows it.
    "smaller than a pixel and on one": {
        "rows": 31, "columns": 41, "distance": 1e4, "panel_width": 1.0, "panel_height": 1.0},
    # Ten kilometres away, a tenth of a millimetre: 3e-10 of a pixel.
    "the smallest panel, farthest away": {
        "rows": 31, "columns": 41, "distance": 1e4, "panel_width": 1e-4, "panel_height": 1e-4},
    # Its corners are 1e7 focal lengths away, and none is near the picture.
    "wholly outside": {"distance": 0.001, "offset_x": 1e4},
    # 1e-4 as wide as high: less than a pixel everywhere.
    "edge-on": {"yaw": STEEP, "distance": 1.2},
    # Turned exactly along the line of sight, so that the quadrilateral has no area up to rounding.
    "on the line of sight": {"yaw": 1.4, "offset_x": -1.2 / math.tan(1.4)},
    # 89.99 degrees about both axes, so that all of the panel's sides look short.
    "edge-on about both axes": {"yaw": STEEP, "pitch": -STEEP, "distance": 2.0},
    # A corner is a thousandth of the distance in front of the camera, 1e5 pictures away.
    "nearly through the image plane": {
        "yaw": STEEP, "distance": 0.3003, "panel_width": 0.6, "offset_x": -1e-4},
    # A hundred-thousandth of the distance in front, with an edge across the picture.
    "a near edge across the picture": {
        "yaw": 1.5, "panel_width": 2.0, "distance": math.sin(1.5) * (1 + 1e-5),
        "offset_x": -math.cos(1.5)},
    # A single pixel at the picture's centre.
    "a picture of one pixel": {"rows": 1, "columns": 1},
    # A corner lies on a pixel's centre, the edges along rows and columns of centres.
    "corners on pixels' centres": {"rows": 31, "columns": 41, "roll": math.pi / 2},
    # The longest lens with the widest panel, whose corners are 1e9 pixels away.
    "the longest lens": {"equivalent_focal_length": 2.0, "distance": 0.001, "panel_width": 100.0},
    # The shortest lens: the picture's corner is 21 focal lengths from the axis.
    "the shortest lens": {"equivalent_focal_length": 0.001, "distance": 0.3, "yaw": 1.0},
}  # fmt: skip


@each_case(PICTURED)
def test_a_panel_in_a_hard_place_is_pictured_pixel_by_pixel(name: str) -> None:
    scene = Scene().replace(**(SMALL | PICTURED[name]))
    frame = occ.render(scene, tolerance=math.inf)
    error = misjudged_by(scene, frame.image > 0)
    record("rim of the panel in the named poses, px", f"{len(PICTURED)} poses", error, 1e-6)
    lit = int((frame.image > 0).sum())
    if name in ("wholly outside", "smaller than a pixel", "on the line of sight"):
        assert lit == 0
    if name in ("smaller than a pixel and on one", "the smallest panel, farthest away"):
        assert lit == 1
    # It is also a picture with every effect of the lens.
    lens = {"radial_k1": 0.05, "point_spread": 0.7, "vignetting_exponent": 4.0}
    assert np.isfinite(occ.render(scene.replace(**lens), tolerance=0).profile).all()


REFUSED: dict[str, tuple[dict[str, float], str]] = {
    # Half of the panel is behind the camera, where it would be pictured upside down.
    "behind the camera": ({"distance": 0.001, "yaw": 0.5}, r"0\.1428\d+ m behind the camera"),
    # The edge is in the camera's plane to the last digit, so that there is nothing to divide by.
    "in the camera's plane": (
        {"distance": 0.5, "yaw": STEEP, "panel_width": 1.0 / math.sin(STEEP)}, "the camera"),
    # In front of it, by less than the rounding of its place.
    "a hair before the camera's plane": (
        {"distance": 0.5 * (1 + 1e-12), "yaw": math.pi / 4, "panel_width": math.sqrt(2.0)},
        "beside the camera"),
    # Half of the largest panel.
    "the largest panel at the smallest distance": (
        {"distance": 0.001, "yaw": STEEP, "panel_width": 100.0}, r"49\.999 m behind the camera"),
    # k_1 = -10 folds at 0.18 focal lengths; the picture ends at 0.83.
    "a lens that folds": ({"radial_k1": -10.0}, "k_1 = -10.* folds the picture before"),
    # It folds and unfolds again inside the picture, so that the corners are unaffected.
    "a lens that folds and unfolds": (
        {"radial_k1": -3.2, "radial_k2": 4.0}, "k_1 = -3.2, k_2 = 4,.* folds the picture before"),
    # Tangential distortion alone folds, and on one side only.
    "a lens far off centre": ({"tangential_p1": 1.0}, "p_1 = 1 .*folds the picture before"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_scene_without_a_picture_is_refused_with_a_sentence(name: str) -> None:
    changes, sentence = REFUSED[name]
    scene = Scene().replace(**(SMALL | changes))
    with pytest.raises(occ.ProjectionError, match=sentence):
        occ.render(scene, force={"distortion": True})
