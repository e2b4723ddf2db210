"""Panels in hard places, lenses that fold, blurs wider than any picture."""

import math
import tracemalloc
from fractions import Fraction
from itertools import product

import cv2
import mpmath
import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import decades, signed_decades, within
from occ_model.camera.coverage import Coverage
from occ_model.camera.optics import Optics
from occ_model.camera.projection import (
    MAX_PIXELS,
    image_points,
    image_rays,
    rotation_of,
    row_spans,
)
from occ_model.effects.defocus import blur_of
from occ_model.effects.distortion import Distortion, distorted
from occ_model.scene.scene import Scene

STEEP = math.radians(89.99)
ANGLES = st.floats(-STEEP, STEEP) | st.sampled_from([0.0, STEEP, -STEEP])
POSES = "d 1 mm to 10 km, panels 0.1 mm to 100 m, turned to 89.99 degrees"
GEOMETRY = {"sensor-noise": False, "fixed-pattern": False, "distortion": True, "defocus": True}


@st.composite
def poses(draw: st.DrawFn) -> Scene:
    """A panel of any size anywhere before a small picture, the lens and the light as they are."""
    distance = draw(decades(1e-3, 1e4))
    size = decades(1e-3, 1e4).map(lambda share: within("panel_width", share * distance))
    aside = st.just(0.0) | st.floats(-1.0, 1.0) | signed_decades(1e-6, 1.0)
    scene = Scene().replace(
        rows=draw(st.integers(1, 24)),
        columns=draw(st.integers(1, 32)),
        equivalent_focal_length=draw(decades(1e-3, 2.0)),
        distance=distance,
        panel_width=draw(size),
        panel_height=draw(size),
        offset_x=distance * draw(aside),
        offset_y=distance * draw(aside),
        yaw=draw(ANGLES),
        pitch=draw(ANGLES),
        roll=draw(st.floats(-math.pi, math.pi) | st.just(0.0)),
        pattern="1",
        illuminance=0.0,
        enhancement="none",
        iso=4e6,
    )
    return draw(
        st.just(scene) | decades(1e-10, 1.0).map(lambda remainder: grazed(scene, remainder))
    )


def grazed(scene: Scene, remainder: float) -> Scene:
    """Move a panel so near that hardly a corner of it is before the camera, on its axis."""
    half = np.array([scene.transmitter.panel_width, scene.transmitter.panel_height]) / 2
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners = signs * [*half, 0.0] @ rotation_of(scene.pose).T
    nearest = corners[corners[:, 2].argmin()]
    distance = within("distance", -nearest[2] * (1.0 + remainder))
    return scene.replace(distance=distance, offset_x=-nearest[0], offset_y=-nearest[1])


class ExactView:
    """The panel as the pinhole camera sees it, in forty digits."""

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
            self.centre = (
                mpmath.mpf(camera.columns - 1) / 2,
                mpmath.mpf(camera.rows - 1) / 2,
            )

    def corners(self) -> list[tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]]:
        """Column, row and depth of each corner; no place for one that is not before the camera."""
        found = []
        with mpmath.workdps(40):
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                at = self.turn * mpmath.matrix([x * self.half[0], y * self.half[1], 0]) + self.place
                depth = at[2] if at[2] else mpmath.mpf("1e-300")
                u, v = (self.focal * at[axis] / depth + self.centre[axis] for axis in (0, 1))
                found.append((u, v, at[2]))
        return found

    def shows(self, column: mpmath.mpf, row: mpmath.mpf) -> bool:
        """Whether the ray of a point in the picture meets the panel."""
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
        """By how many pixels a pixel misses to be seen otherwise, to a factor of ten."""
        is_in = self.shows(mpmath.mpf(column), mpmath.mpf(row))
        for power in range(-16, 3):
            step = mpmath.mpf(10) ** power
            for down, right in product((-1, 0, 1), repeat=2):
                if self.shows(column + right * step, row + down * step) != is_in:
                    return float(step)
        return math.inf


def rays_meet(scene: Scene) -> np.ndarray:
    """Which pixels' rays meet the panel, in floating point, shape (rows, columns)."""
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


def misjudged(scene: Scene, seen: np.ndarray) -> float:
    """How far from the panel's rim a pixel lies that is seen wrongly, in pixels."""
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
        # Not one that is clearly before the camera.
        assert min(depths) <= 1e-6 * pose.distance + 1e-15 * reach
        return
    worst = 0.0
    for (u, v, depth), corner in zip(exact, found.tolist(), strict=True):
        # A depth next to nothing is a difference: so many digits less has the place.
        size = scene.camera.focal_length_pixels * 2 * reach / float(depth) + scene.camera.columns
        off = max(abs(float(u - corner[0])), abs(float(v - corner[1])))
        worst = max(worst, off / size * (float(depth) / reach))
    record("corners, of the panel's reach", POSES, worst)
    assert worst <= 2e-15


@cases(scene=poses())
def test_a_pixel_shows_the_panel_just_where_its_ray_meets_it(scene: Scene) -> None:
    try:
        seen = occ.render(scene, tolerance=math.inf).image > 0
    except occ.ProjectionError:
        return  # whether it may be is the law of the corners
    error = misjudged(scene, seen)
    record("rim of the panel against each pixel's ray, px", POSES, error)
    assert error <= 1e-3


@st.composite
def quads(draw: st.DrawFn) -> np.ndarray:
    """Four corners round an ellipse of any size and place, to a billion pixels."""
    angles = sorted(draw(st.lists(st.floats(0, 6.28), min_size=4, max_size=4, unique=True)))
    wide, high = draw(decades(1e-3, 1e9)), draw(decades(1e-3, 1e9))
    turn, way = draw(st.floats(0, 3.15)), draw(st.sampled_from([1, -1]))
    x, y = draw(st.floats(-1.2, 1.2)), draw(st.floats(-1.2, 1.2))
    circle = np.array([(wide * math.cos(a), high * math.sin(a)) for a in angles])
    turned = circle @ [[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]]
    # Its rim passes near the picture, whatever its size.
    if draw(st.booleans()):
        # Upright edges, which must be so to the last digit, and level ones.
        turned = np.array([[-wide, -high], [wide, -high], [wide, high], [-wide, high]])
    quad = turned + np.array([20 + x * min(wide, 1e6), 6 + y * min(high, 1e6)])
    return quad[::way] if draw(st.booleans()) else np.rint(quad)[::way]


def crossings(polygon: np.ndarray, row: int) -> list[Fraction]:
    """Where a row crosses the outline, exactly, in order; a corner counts for one of its edges."""
    found = []
    points = [tuple(map(Fraction, point)) for point in polygon.tolist()]
    for (x0, y0), (x1, y1) in zip(points, [*points[1:], points[0]], strict=True):
        if (y0 <= row) != (y1 <= row):
            found.append(x0 + (row - y0) / (y1 - y0) * (x1 - x0))
    return sorted(found)


@cases(quad=quads())
def test_row_spans_are_those_of_rational_arithmetic(quad: np.ndarray) -> None:
    rows, columns = 12, 41
    first, last = row_spans(quad, rows, columns)
    worst = Fraction(0)
    for row in range(rows):
        ends = crossings(quad, row) or [Fraction(columns)] * 2
        left, right = ends[0], ends[-1]
        for column in range(columns):
            found = bool(first[row] <= column < last[row])
            if found != (left <= column < right):
                worst = max(worst, min(abs(column - left), abs(column - right)))
    size = max(float(np.abs(quad).max()), columns)
    error = float(worst) / size
    record("row_spans: a misjudged centre's distance, of the corners'", "to 1e9 px", error)
    assert error <= 1e-15


@st.composite
def stars(draw: st.DrawFn) -> np.ndarray:
    """A concave polygon round a point near the picture, of any size."""
    count = draw(st.integers(3, 12))
    size = draw(decades(1e-2, 1e6))
    reach = draw(st.lists(st.floats(0.05, 1.0), min_size=count, max_size=count))
    turn = draw(st.floats(0, 6.28))
    angle = turn + 2 * np.pi * np.arange(count) / count
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * np.array(reach)[:, None] * size
    star = circle + np.array([draw(st.floats(-20, 60)), draw(st.floats(-10, 30))])
    star = np.rint(star) if draw(st.booleans()) else star
    return star[:: draw(st.sampled_from([1, -1]))]


@cases(star=stars())
def test_sharp_coverage_is_that_of_rational_arithmetic(star: np.ndarray) -> None:
    rows, columns = 12, 41
    found = Coverage(star, rows, columns).rows(0, rows)
    assert np.isin(found, [0.0, 1.0]).all()
    worst = Fraction(0)
    for row in range(rows):
        ends = crossings(star, row)
        for column in range(columns):
            inside = sum(end <= column for end in ends) % 2 == 1
            if inside != bool(found[row, column]):
                worst = max(worst, min((abs(column - end) for end in ends), default=Fraction(99)))
    size = max(float(np.abs(star).max()), columns)
    error = float(worst) / size
    record("coverage: a misjudged centre's distance, of the corners'", "to 1e6 px", error)
    assert error <= 1e-15


@cases(star=stars(), blur=decades(0.05, 30.0))
def test_a_blur_loses_no_light(star: np.ndarray, blur: float) -> None:
    margin = math.ceil(5 * blur) + 2
    outline = star / max(np.abs(star - star.mean(axis=0)).max() / 40.0, 1.0)
    outline = outline - outline.min(axis=0) + margin
    width, height = np.ceil(np.ptp(outline, axis=0)).astype(int) + 2 * margin
    sharp = Coverage(outline, height, width).rows(0, height).sum(dtype=np.float64)
    assume(sharp > 0)
    blurred = Coverage(outline, height, width, blur).rows(0, height).sum(dtype=np.float64)
    error = abs(blurred / sharp - 1.0)
    record("light after a blur, relative", "panels of 1 to 80 px, blur 0.05 to 30 px", error)
    assert error <= 2e-3


def normal(x: float) -> float:
    return 0.5 * math.erfc(-x / math.sqrt(2.0))


@cases(
    blur=decades(8.0, 1e9),
    left=st.floats(-4.0, 3.0),
    top=st.floats(-4.0, 3.0),
    width=decades(0.05, 1e3),
    height=decades(0.05, 1e3),
)
def test_the_widest_blur_of_a_rectangle_is_the_product_of_two_normal_distributions(
    blur: float, left: float, top: float, width: float, height: float
) -> None:
    ends = np.array([left, left + width, top, top + height]) * blur
    outline = np.array([ends[[0, 2]], ends[[1, 2]], ends[[1, 3]], ends[[0, 3]]])
    found = Coverage(outline, 3, 5, blur).rows(0, 3)
    # A panel is made of the pixels whose centres it covers.
    x0, x1, y0, y1 = (np.ceil(ends) - 0.5).tolist()
    across = [normal((x1 - c) / blur) - normal((x0 - c) / blur) for c in range(5)]
    down = [normal((y1 - r) / blur) - normal((y0 - r) / blur) for r in range(3)]
    error = float(np.abs(found - np.outer(down, across)).max())
    record("a wide blur against the normal distribution", "blur 8 to 1e9 px", error)
    assert error <= 6e-3


@st.composite
def lenses(draw: st.DrawFn) -> dict[str, float]:
    """Coefficients of all sizes, up to the largest allowed."""
    small = st.just(0.0) | signed_decades(1e-9, 1.0)
    k1, k2 = (10.0 * draw(small) for _ in range(2))
    p1, p2 = (draw(small) for _ in range(2))
    return {"radial_k1": k1, "radial_k2": k2, "tangential_p1": p1, "tangential_p2": p2}


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
    # Every pictured corner that is in the picture is a corner of the outline,
    rays = image_rays(corners, scene.camera)
    pictured = opencv_places(rays, scene)
    inside = ((pictured >= 0) & (pictured <= [799, 599])).all(axis=1)
    near = np.hypot(*np.abs(rays).T) < 0.5 * math.hypot(600, 800) / scene.camera.focal_length_pixels
    for corner in pictured[inside & near]:
        error = float(np.hypot(*(outline - corner).T).min())
        record("distorted corners against OpenCV, px", "k to 10, p to 1", error)
        assert error <= 1e-9
    # and every edge of it that is in the picture lies along the curve.
    share = np.linspace(0, 1, 41)[:, None, None]
    line = rays * (1 - share) + np.roll(rays, -1, axis=0) * share
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
    record("distorted edges against OpenCV, px", "k to 10, p to 1", error)
    assert error <= 0.02


@cases(lens=lenses(), x=signed_decades(1e-9, 1e3), y=signed_decades(1e-9, 1e3))
def test_browns_equation_is_that_of_forty_digits(
    lens: dict[str, float], x: float, y: float
) -> None:
    found = distorted(np.array([x, y]), Scene().replace(**lens).lens)
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
    record("Brown's equation, of its terms", "rays to 1000 focal lengths", error)
    assert error <= 2e-15


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
        bounds = all(math.isfinite(decision.bound) for decision in frame.plan.decisions)
        error = 0.0 if finite and bounds else 1.0
    record("a picture or a sentence, and no number that is none", f"{POSES}, any lens", error)
    assert error == 0.0


SMALL = {"rows": 30, "columns": 40, "pattern": "1", "illuminance": 0.0, "enhancement": "none"}

PICTURED: dict[str, dict[str, float]] = {
    # Each pixel covers a thousandth of it: corners lie a thousand pictures away.
    "a thousand times the picture": {"distance": 0.001, "panel_width": 1.0, "panel_height": 1.0},
    # The same turned and tilted: edges between corners of 1e4 pixels pass the picture or do not.
    "a thousand times the picture, turned": {
        "distance": 0.001, "panel_width": 1.0, "panel_height": 1.0, "roll": 0.7},
    # Less than a pixel, between the four central ones: no pixel's centre lies on it.
    "smaller than a pixel": {"distance": 1e4, "panel_width": 1.0, "panel_height": 1.0},
    # As small, on a pixel's centre: just that one shows it.
    "smaller than a pixel and on one": {
        "rows": 31, "columns": 41, "distance": 1e4, "panel_width": 1.0, "panel_height": 1.0},
    # Ten kilometres away, a tenth of a millimetre: 3e-10 of a pixel.
    "the smallest panel, farthest away": {
        "rows": 31, "columns": 41, "distance": 1e4, "panel_width": 1e-4, "panel_height": 1e-4},
    # Its corners lie 1e7 focal lengths off, and none near the picture.
    "wholly outside": {"distance": 0.001, "offset_x": 1e4},
    # 1e-4 as wide as high: less than a pixel everywhere.
    "edge-on": {"yaw": STEEP, "distance": 1.2},
    # Turned to the line of sight exactly: the quadrilateral has no area but for rounding.
    "on the line of sight": {"yaw": 1.4, "offset_x": -1.2 / math.tan(1.4)},
    # 89.99 degrees about both axes: of the panel's sides none is seen at its length.
    "edge-on about both axes": {"yaw": STEEP, "pitch": -STEEP, "distance": 2.0},
    # A corner is a thousandth of the distance before the camera: it lies 1e5 pictures off.
    "nearly through the image plane": {
        "yaw": STEEP, "distance": 0.3003, "panel_width": 0.6, "offset_x": -1e-4},
    # A hundred-thousandth of the distance before it, and the edge there crosses the picture.
    "a near edge across the picture": {
        "yaw": 1.5, "panel_width": 2.0, "distance": math.sin(1.5) * (1 + 1e-5),
        "offset_x": -math.cos(1.5)},
    # One pixel, at the picture's very centre.
    "a picture of one pixel": {"rows": 1, "columns": 1},
    # A corner lies on a pixel's centre, the edges along rows and columns of centres.
    "corners on pixels' centres": {"rows": 31, "columns": 41, "roll": math.pi / 2},
    # The longest lens before the widest panel: corners of 1e9 pixels.
    "the longest lens": {"equivalent_focal_length": 2.0, "distance": 0.001, "panel_width": 100.0},
    # The shortest: the picture's corner is 21 focal lengths off the axis.
    "the shortest lens": {"equivalent_focal_length": 0.001, "distance": 0.3, "yaw": 1.0},
}  # fmt: skip


@pytest.mark.parametrize("name", PICTURED)
def test_a_panel_in_a_hard_place_is_pictured_pixel_by_pixel(name: str) -> None:
    scene = Scene().replace(**(SMALL | PICTURED[name]))
    frame = occ.render(scene, tolerance=math.inf)
    error = misjudged(scene, frame.image > 0)
    record("rim of the panel in the named poses, px", f"{len(PICTURED)} poses", error)
    assert error <= 1e-6
    lit = int((frame.image > 0).sum())
    if name in ("wholly outside", "smaller than a pixel", "on the line of sight"):
        assert lit == 0
    if name in ("smaller than a pixel and on one", "the smallest panel, farthest away"):
        assert lit == 1
    # With every effect of the lens it is a picture as well.
    lens = {"radial_k1": 0.05, "point_spread": 0.7, "vignetting_exponent": 4.0}
    assert np.isfinite(occ.render(scene.replace(**lens), tolerance=0).profile).all()


REFUSED: dict[str, tuple[dict[str, float], str]] = {
    # Half of the panel is behind the camera, where it would be pictured upside down.
    "behind the camera": ({"distance": 0.001, "yaw": 0.5}, r"0\.1428\d+ m behind the camera"),
    # The edge is in the camera's plane to the last digit: nothing to divide by.
    "in the camera's plane": (
        {"distance": 0.5, "yaw": STEEP, "panel_width": 1.0 / math.sin(STEEP)}, "the camera"),
    # Before it, by less than the rounding of where it is.
    "a hair before the camera's plane": (
        {"distance": 0.5 * (1 + 1e-12), "yaw": math.pi / 4, "panel_width": math.sqrt(2.0)},
        "beside the camera"),
    # Half of the largest panel.
    "the largest panel at the smallest distance": (
        {"distance": 0.001, "yaw": STEEP, "panel_width": 100.0}, r"49\.999 m behind the camera"),
    # k_1 = -10 folds at 0.18 focal lengths; the picture ends at 0.83.
    "a lens that folds": ({"radial_k1": -10.0}, "k_1 = -10.* folds the picture back"),
    # It folds and unfolds again within the picture: the corners themselves are unharmed.
    "a lens that folds and unfolds": (
        {"radial_k1": -3.2, "radial_k2": 4.0}, "k_1 = -3.2, k_2 = 4,.* folds the picture back"),
    # Tangential distortion alone folds, and on one side only.
    "a lens far off centre": ({"tangential_p1": 1.0}, "p_1 = 1 .*folds the picture back"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_picture_is_refused_with_a_sentence(name: str) -> None:
    changes, sentence = REFUSED[name]
    scene = Scene().replace(**(SMALL | changes))
    with pytest.raises(occ.ProjectionError, match=sentence):
        occ.render(scene, force={"distortion": True})


@pytest.mark.parametrize("blur", [0.0, 30.0, 1000.0])
@pytest.mark.parametrize("k1", [-0.1, -0.19])
def test_a_lens_that_folds_beyond_the_picture_is_not_refused_for_its_blur(
    k1: float, blur: float
) -> None:
    # Light from so far out takes part that the lens is looked at where it has long folded.
    scene = Scene().replace(**(SMALL | {"radial_k1": k1, "point_spread": blur, "distance": 0.02}))
    scene = scene.replace(focus_distance=0.001 if blur == 1000.0 else 0.0, f_number=0.5)
    assert (occ.render(scene, force=GEOMETRY).image > 0).all()


HUGE: dict[str, dict[str, int]] = {
    # 1e11 pixels, each number within its range.
    "the most rows and columns": {"rows": 100_000, "columns": 1_000_000},
    # One row too many.
    "a row too many": {"rows": MAX_PIXELS // 1_000_000 + 1, "columns": 1_000_000},
    "as many columns as rows": {"rows": 100_000, "columns": 100_000},
}


@pytest.mark.parametrize("lens", [{}, {"point_spread": 1000.0, "radial_k1": 0.1}])
@pytest.mark.parametrize("name", HUGE)
def test_a_picture_that_would_fill_the_memory_is_refused_before_any_of_it_is_made(
    name: str, lens: dict[str, float]
) -> None:
    scene = Scene().replace(**HUGE[name], **lens)
    tracemalloc.start()
    with pytest.raises(occ.ProjectionError, match=r"million pixels; allowed: up to 170 million\.$"):
        occ.render(scene)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1e6


def test_the_widest_blur_of_the_widest_picture_takes_no_more_memory_than_a_narrow_one() -> None:
    # A blur of 1e8 pixels once took a row of numbers for each pixel that it reaches to.
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


@pytest.mark.parametrize("columns", [32_766, 32_768, 70_000, 200_000])
def test_a_blurred_picture_wider_than_a_short_integer_is_right_everywhere(columns: int) -> None:
    # OpenCV counts the places of a transformed picture in 16 bits.
    ends = np.array([0.3, 0.9]) * columns
    outline = np.array([[ends[0], -99], [ends[1], -99], [ends[1], 99], [ends[0], 99]])
    found = Coverage(outline, 2, columns, 8.5).rows(0, 2)
    column = np.arange(columns)
    x0, x1 = (np.ceil(ends) - 0.5).tolist()
    spans = (x0 - 45 <= column) & (column <= x0 + 45) | (x1 - 45 <= column) & (column <= x1 + 45)
    expected = ((x0 < column) & (column < x1)).astype(float)
    expected[spans] = [
        normal((x1 - c) / 8.5) - normal((x0 - c) / 8.5) for c in column[spans].tolist()
    ]
    np.testing.assert_allclose(found, np.tile(expected, (2, 1)), rtol=0, atol=5e-3)


@pytest.mark.parametrize("spread", [5e-324, 1e-160, 1e-8, 0.01])
def test_a_blur_of_next_to_nothing_leaves_the_picture_sharp(spread: float) -> None:
    # Its square is 0 in floating point: a Gaussian of it divides by nothing.
    scene = Scene().replace(**(SMALL | {"roll": 0.3}))
    sharp = occ.render(scene, tolerance=math.inf).image
    blurred = occ.render(scene.replace(point_spread=spread), tolerance=0, force=GEOMETRY).image
    np.testing.assert_array_equal(blurred > 0, sharp > 0)


@pytest.mark.parametrize("side", range(3, 60, 7))
def test_an_upright_edge_on_pixels_centres_is_not_jagged(side: int) -> None:
    # x (1 - s) + x s is not x for every s: a row in ten lost a pixel, and with it its level look.
    for x in range(side, side + 7):
        outline = np.array([[x, -9.7], [90, -9.7], [90, 411.3], [x, 411.3]])
        first, last = row_spans(outline, 300, 80)
        assert (first == x).all()
        assert (last == 80).all()
        np.testing.assert_array_equal(
            Coverage(outline, 300, 80).rows(0, 300), np.tile(np.arange(80) >= x, (300, 1))
        )


def test_a_lens_bends_rays_and_points_of_the_picture_back_and_forth() -> None:
    camera = Scene().replace(rows=3, columns=5).camera
    points = np.array([[0.0, 0.0], [4.0, 2.0], [1e9, -1e9]])
    np.testing.assert_allclose(image_points(image_rays(points, camera), camera), points, rtol=1e-14)
