"""Any scene that the declarations allow, with any effects, gives a picture or a sentence why
not."""

import math
from collections.abc import Callable
from itertools import product
from typing import TypeVar

import numpy as np
from each_case import each_case
from hypothesis import strategies as st
from scene_values import values_of

import occ_model as occ
from hard_cases.laws import cases, record
from hard_cases.references import PATTERNS, decades, signed_decades, within
from occ_model.effects.registry import NAMES
from occ_model.scene.canonical_text import CanonicalText
from occ_model.scene.parameter_kinds import ChipPattern, Choice, Count, Payload
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import OBSERVABLES, Observable, Scene

Result = TypeVar("Result")


def quantities(name: str) -> st.SearchStrategy[float | int | str]:
    """Draw any value that a parameter may have, with its limits and every decade."""
    declared = PARAMETERS[name]
    if isinstance(declared, Choice):
        return st.sampled_from(declared.choices)
    if isinstance(declared, ChipPattern):
        return PATTERNS
    if isinstance(declared, Payload | CanonicalText):
        return values_of(declared)
    if isinstance(declared, Count):
        return st.integers(declared.low, declared.high)
    low, high, default = declared.low, declared.high, declared.default
    some = [st.sampled_from([low, high, default]), st.floats(low, high)]
    if low > 0.0:
        some.append(decades(low, high))
    else:
        tiny = decades(1e-300, high) if low == 0.0 else signed_decades(1e-300, high)
        some.append(tiny.map(lambda value: within(name, value)))
    return st.one_of(some)


SIZES = {
    "rows": st.integers(1, 24),
    "columns": st.integers(1, 48),
    "bits": st.integers(2, 16),
    "code": st.integers(0, 3),
}
CHANGES = st.fixed_dictionaries(
    SIZES, optional={name: quantities(name) for name in PARAMETERS if name not in SIZES}
)
"""Any parameters of small pictures; the others have their defaults."""


def make_or_explain(make: Callable[[], Result]) -> Result | str:
    """Return what is made of a scene, or the sentence why it cannot be made."""
    try:
        return make()
    except occ.OccError as error:
        return str(error)


@cases(changes=CHANGES, observable=st.sampled_from(OBSERVABLES), tolerance=decades(1e-6, 1e6))
def test_every_bound_of_any_scene_is_a_number_and_not_negative(
    changes: dict[str, float | int | str], observable: Observable, tolerance: float
) -> None:
    scene = Scene().replace(**changes)
    plan = make_or_explain(lambda: occ.plan(scene, tolerance, observable))
    if isinstance(plan, str):
        assert plan.endswith(".")
        return
    wrong = 0
    for decision in plan.decisions:
        # A lens that folds the picture has an infinite bound, and its simulation is refused.
        folds = decision.effect == "distortion" and decision.estimate == math.inf
        wrong += not (folds or (math.isfinite(decision.estimate) and decision.estimate >= 0.0))
        if folds:
            assert isinstance(make_or_explain(lambda: occ.render(scene, tolerance=0)), str)
    law = "bounds that are no number or negative"
    record(law, "all parameters, all allowed", float(wrong), 0.0)


@cases(
    changes=CHANGES, tolerance=st.sampled_from([0.0, 0.5, math.inf]),
    force=st.sampled_from([True, None]),
)  # fmt: skip
def test_any_scenes_picture_has_pixels_and_a_finite_profile(
    changes: dict[str, float | int | str], tolerance: float, force: bool | None
) -> None:
    scene = Scene().replace(**changes)
    by_hand = dict.fromkeys(NAMES, force) if force else None
    frame = make_or_explain(lambda: occ.render(scene, tolerance=tolerance, force=by_hand))
    if isinstance(frame, str):
        assert frame.endswith(".")
        return
    assert frame.image.dtype == np.uint8
    assert frame.image.shape == (scene.camera.rows, scene.camera.columns)
    assert frame.profile.shape == (scene.camera.columns,)
    assert np.isfinite(frame.corners).all()
    beyond = max(0.0, -float(frame.profile.min()), float(frame.profile.max()) - 255.0)
    record("profiles beyond 0 to 255, levels", "all parameters, all allowed", beyond, 0.0)


SCENES: dict[str, dict[str, float | int | str]] = {
    # A gain that hardly varies, where squares of its noise and of 255 over it underflow or
    # overflow.
    "noise of next to nothing": {"gain_variation": 1e-157, "lambertian_order": 2.0},
    # No light: every pixel value is 0, and so are divisors.
    "no light": {"luminance": 0.0, "illuminance": 0.0, "gain_variation": 0.5, "edge_time": 1.0},
    # As much light as possible, 1e29 times white, in single precision with vignetting.
    "all light": {"luminance": 1e16, "illuminance": 1e16, "reflectance": 1.0, "iso": 4e6,
                  "exposure_time": 1e6, "f_number": 0.5, "gamma": 1.0, "vignetting_exponent": 1.0},
    # As little light as possible, 1e-31 times white, which underflows in single precision.
    "hardly any light": {"luminance": 1e-16, "illuminance": 1e-16, "iso": 1.0, "gamma": 1.0,
                         "exposure_time": 1e-9, "f_number": 128.0, "vignetting_exponent": 20.0},
    # The panel's own light is lost in the last digit of the reflected light.
    "a panel lost in the sun": {"luminance": 1e-9, "illuminance": 1e9},
    # Light that has fewer digits than a float has, the smallest number but 0.
    "the smallest luminance there is": {"luminance": 5e-324, "illuminance": 0.0},
    # The steepest gamma, where next to black one ulp of light is a grey level.
    "the steepest gamma": {"gamma": 4.0, "luminance": 1e-12, "illuminance": 0.0},
    # The corner gets 1e-27 of the light on the axis.
    "the corner of a fisheye": {"equivalent_focal_length": 1e-3, "vignetting_exponent": 20.0,
                                "distance": 1e-3, "panel_width": 100.0, "panel_height": 100.0},
    # A panel nearly edge-on with its light in a beam: cos^99 of nearly a right angle.
    "a beam from the side": {"yaw": math.radians(89.99), "lambertian_order": 100.0,
                             "panel_width": 1e-4, "point_spread": 3.0},
    # A picture of one pixel: no two columns to compare, no interval between them.
    "one pixel": {"rows": 1, "columns": 1, "point_spread": 2.0, "jpeg_quality": 1},
    # An LED whose edges take less than the smallest normal number of chips; eight columns are
    # divided at once, and one more.
    "edges of next to nothing": {"edge_time": 5e-324, "columns": 9},
    # A blur a hundred times as wide as the picture.
    "a blur wider than the picture": {"point_spread": 1000.0, "focus_distance": 1e-300},
}  # fmt: skip


@each_case(product(SCENES, OBSERVABLES))
def test_a_hard_scene_is_planned_and_pictured(name: str, observable: Observable) -> None:
    scene = Scene().replace(**({"rows": 24, "columns": 48} | SCENES[name]))
    frame = occ.render(scene, tolerance=0, observable=observable, force=dict.fromkeys(NAMES, True))
    assert np.isfinite(frame.profile).all()
    assert all(0.0 <= one.estimate < math.inf for one in frame.plan.decisions)
    assert 0.0 <= frame.profile.min() <= frame.profile.max() <= 255.0
