"""Laws of pictures with effects, and of their profiles, plans and times."""

import math

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.enhancement import enhance
from occ_model.camera.photometry import ColumnLight, panel_values
from occ_model.camera.projection import row_spans
from occ_model.effects.light_effects import Flicker, LedEdges
from occ_model.effects.registry import EFFECTS, NAMES
from occ_model.effects.sensor_effects import FullWell
from occ_model.results.frame import Frame
from occ_model.scene.scene import Scene

ROWS, COLUMNS = 200, 400
COLUMN_EFFECTS = {"led-edges", "flicker", "full-well"}
NOISE = {"sensor-noise": False, "fixed-pattern": False}

ALL: dict[str, float | int] = {
    "edge_time": 20e-6,
    "flicker_depth": 0.5,
    "lambertian_order": 2.0,
    "radial_k1": -0.15,
    "point_spread": 1.5,
    "vignetting_exponent": 4.0,
    "jpeg_quality": 90,
}
"""Parameters with which every effect is present."""


@pytest.fixture(scope="module")
def scene() -> Scene:
    """Make a panel in the middle of a small picture, with no effect except sensor noise."""
    bare = occ.load_preset("phone-136us")
    return bare.replace(rows=ROWS, columns=COLUMNS, enhancement="none", start_time=1.2345e-4)


def whole(scene: Scene) -> Scene:
    """Make the same with every effect; low ISO speed and bright light fill the well."""
    return scene.replace(**ALL, iso=20.0, luminance=1e5, illuminance=3e4)


def pixels_inside(frame: Frame) -> np.ndarray:
    """Return which pixels lie on the panel."""
    first, last = row_spans(frame.corners, ROWS, COLUMNS)
    column = np.arange(COLUMNS)
    return np.asarray((column >= first[:, None]) & (column < last[:, None]))


def means_inside(frame: Frame) -> tuple[np.ndarray, np.ndarray]:
    """Return which columns show the panel, and the means of its pixels in them."""
    inside = pixels_inside(frame)
    seen = np.asarray(inside.any(axis=0))
    assert 0.2 < seen.mean() < 1.0
    return seen, frame.image.sum(axis=0, where=inside)[seen] / inside.sum(axis=0)[seen]


@pytest.mark.parametrize("enhancement", ["none", "stretch", "equalization"])
def test_without_a_limit_the_picture_is_the_papers(scene: Scene, enhancement: str) -> None:
    complete = whole(scene).replace(enhancement=enhancement, roll=0.3)
    frame = occ.render(complete, tolerance=math.inf)
    assert frame.plan.included == ()
    np.testing.assert_array_equal(frame.profile, occ.column_profile(complete))
    inside = pixels_inside(frame)
    dark = occ.column_profile(complete.replace(pattern="0"))[0]
    expected = np.where(inside, frame.signal, np.rint(dark))
    np.testing.assert_array_equal(frame.image, expected)


def test_at_zero_tolerance_every_effect_present_is_included(scene: Scene) -> None:
    assert occ.render(whole(scene), tolerance=0).plan.included == NAMES
    assert set(occ.render(scene, tolerance=0).plan.included) == set(NOISE)
    for one, value in ALL.items():
        chosen = scene.replace(**{one: value})
        there = {effect.name for effect in EFFECTS if effect.is_present(chosen)}
        assert there - set(NOISE) == {next(e.name for e in EFFECTS if one in e.parameters)}
        assert set(occ.plan(chosen, tolerance=0).included) == there


@pytest.mark.parametrize("name", NAMES)
def test_an_effect_is_switched_on_and_off_by_hand(scene: Scene, name: str) -> None:
    complete = whole(scene)
    off = occ.render(complete, tolerance=0, force={name: False})
    assert set(off.plan.included) == set(NAMES) - {name}
    on = occ.render(complete, tolerance=math.inf, force={name: True})
    assert on.plan.included == (name,)
    bare = occ.render(complete, tolerance=math.inf)
    assert not np.array_equal(on.image, bare.image)
    assert not np.array_equal(off.image, occ.render(complete, tolerance=0).image)


@pytest.mark.parametrize("name", sorted(set(NAMES) - set(NOISE)))
def test_an_absent_effect_changes_nothing_when_switched_on(scene: Scene, name: str) -> None:
    turned = scene.replace(roll=0.3, averaging="light", enhancement="equalization")
    for chosen in (scene, turned):
        bare = occ.render(chosen, tolerance=math.inf)
        forced = occ.render(chosen, tolerance=math.inf, force={name: True})
        assert forced.plan.included == (name,)
        np.testing.assert_array_equal(forced.image, bare.image)
        largest = 0.51 if name == "jpeg" else 1e-4  # of bytes, in a file
        np.testing.assert_allclose(forced.profile, bare.profile, rtol=0, atol=largest)


def test_every_effect_that_is_simulated_is_timed(scene: Scene) -> None:
    complete = whole(scene)
    frame = occ.render(complete, tolerance=0)
    assert set(NAMES) <= set(frame.timings)
    frame = occ.render(complete, tolerance=0, force={"sensor-noise": False})
    assert set(NAMES) - set(frame.timings) == {"sensor-noise"}
    assert all(seconds >= 0.0 for seconds in frame.timings.values())
    assert not set(occ.render(scene, tolerance=math.inf).timings) & set(NAMES)


@pytest.mark.parametrize("pose", [{"distance": 1.2}, {"distance": 0.8, "roll": 0.2, "yaw": 0.4}])
@pytest.mark.parametrize("effects", ["noise", "all", "all but the file", "all but noise"])
def test_the_profile_is_the_mean_of_the_panels_pixels(
    scene: Scene, effects: str, pose: dict[str, float]
) -> None:
    complete = (scene if effects == "noise" else whole(scene)).replace(**pose)
    if effects == "noise":
        complete = complete.replace(illuminance=3000.0)
    force = NOISE if effects == "all but noise" else {}
    if effects != "all":
        complete = complete.replace(jpeg_quality=0)
    # A panel that is straight and sharp, so that its pixels are known.
    complete = complete.replace(radial_k1=0.0, point_spread=0.0)
    frame = occ.render(complete, tolerance=0, force=force)
    seen, means = means_inside(frame)
    largest = 0.51 if effects != "noise" else 0.25  # noise dithers the rounding
    np.testing.assert_allclose(frame.profile[seen], means, rtol=0, atol=largest)


@pytest.mark.parametrize("enhancement", ["none", "stretch", "equalization"])
@pytest.mark.parametrize("quality", [0, 90])
@pytest.mark.parametrize("roll", [0.0, 0.3])
def test_the_signal_is_the_mean_of_the_panels_enhanced_pixels(
    scene: Scene, roll: float, quality: int, enhancement: str
) -> None:
    complete = whole(scene).replace(
        distance=1.2, roll=roll, jpeg_quality=quality, enhancement=enhancement
    )
    # A panel that is straight and sharp, so that its pixels are known.
    frame = occ.render(complete.replace(radial_k1=0.0, point_spread=0.0), tolerance=0)
    assert {"image", "noise"} <= frame.plan.kinds
    seen, means = means_inside(frame)
    np.testing.assert_allclose(frame.signal[seen], means, rtol=0, atol=1e-9)


@pytest.mark.parametrize("changes", [{"illuminance": 0.0}, {"iso": 6400.0, "luminance": 370.0}])
def test_the_profile_is_the_mean_of_noisy_clipped_pixels(
    scene: Scene, changes: dict[str, float]
) -> None:
    frame = occ.render(scene.replace(distance=0.05, **changes), tolerance=0)
    assert ((frame.image == 0) | (frame.image == 255)).mean() > 0.01
    np.testing.assert_allclose(frame.profile, frame.image.mean(axis=0), rtol=0, atol=0.5)


@pytest.mark.parametrize(
    ("roll", "enhancement"), [(0.0, "none"), (0.3, "stretch"), (0.3, "equalization")]
)
def test_column_effects_alone_leave_profile_and_signal_to_the_columns(
    scene: Scene, roll: float, enhancement: str
) -> None:
    complete = whole(scene).replace(roll=roll, enhancement=enhancement)
    force = {name: name in COLUMN_EFFECTS for name in NAMES}
    frame = occ.render(complete, force=force)
    assert set(frame.plan.included) == COLUMN_EFFECTS
    assert frame.plan.kinds == {"column"}
    light = Flicker().apply(complete, LedEdges().apply(complete, ColumnLight.of(complete)))
    columns = FullWell().apply(complete, panel_values(complete, light))
    np.testing.assert_array_equal(frame.profile, np.minimum(columns, 255.0))
    np.testing.assert_array_equal(frame.signal, enhance(frame.profile, enhancement))
    first, last = row_spans(frame.corners, ROWS, COLUMNS)
    for row in range(0, ROWS, 7):
        span = slice(first[row], last[row])
        np.testing.assert_array_equal(frame.image[row, span], frame.signal[span])


@pytest.mark.parametrize("enhancement", ["none", "stretch", "equalization"])
@pytest.mark.parametrize("roll", [0.0, 0.3])
def test_pictures_made_by_columns_and_by_pixels_are_the_same(
    scene: Scene, enhancement: str, roll: float
) -> None:
    """A lens that does nothing, but is switched on, selects the simulation by pixels."""
    complete = whole(scene).replace(enhancement=enhancement, roll=roll, point_spread=0.0)
    columns = {name: name in COLUMN_EFFECTS for name in NAMES}
    by_columns = occ.render(complete, force=columns)
    by_pixels = occ.render(complete, force=columns | {"defocus": True})
    np.testing.assert_array_equal(by_pixels.image, by_columns.image)
    np.testing.assert_allclose(by_pixels.profile, by_columns.profile, rtol=1e-6)
