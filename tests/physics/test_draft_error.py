"""A draft's column means lie as near to those of the whole picture as it says."""

import math

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.effects.paper_view import paper_view_of
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene

OBSERVED = ("profile", "signal")


def random_scene(random: np.random.Generator) -> Scene:
    """A small picture with all effects, each of any size; every second panel is turned."""
    distance = float(random.uniform(0.3, 3.0))
    seen = random.uniform(0.2, 1.5, size=2) * distance
    changes: dict[str, ParameterValue] = {
        name: declared.at(float(random.random()))
        for name, declared in PARAMETERS.items()
        if isinstance(declared, Quantity)
    }
    changes |= {
        "rows": int(random.integers(100, 600)),
        "columns": int(random.integers(60, 300)),
        "code": int(random.integers(1024)),
        "averaging": str(random.choice(["light", "pixel-value"])),
        "enhancement": str(random.choice(["equalization", "stretch", "none"])),
        "jpeg_quality": int(random.choice([0, *random.integers(1, 101, size=3)])),
        "equivalent_focal_length": float(random.uniform(0.02, 0.06)),
        "distance": distance,
        "panel_width": float(seen[0]),
        "panel_height": float(seen[1]),
        "offset_x": float(random.normal() * 0.2 * distance),
        "offset_y": float(random.normal() * 0.2 * distance),
        "radial_k1": float(random.uniform(-0.15, 0.15)),
        "radial_k2": float(random.uniform(-0.15, 0.15)),
        "luminance": float(10 ** random.uniform(2.5, 5.0)),
        "illuminance": float(10 ** random.uniform(1.0, 4.0)),
        "pixel_pitch": float(10 ** random.uniform(-6.0, -5.0)),
    }
    if random.random() < 0.5:
        changes |= {"yaw": 0.0, "pitch": 0.0, "roll": 0.0}
    return Scene().replace(**changes)


def errors(scene: Scene, step: int) -> list[tuple[float, float]]:
    """The error found and the one stated, of the profile and of the signal."""
    whole = occ.render(scene, tolerance=0.0, seed=1)
    draft = occ.render(scene, tolerance=0.0, seed=2, noise="reused", rows_step=step)
    region = paper_view_of(scene).region
    columns = slice(region.first_column, region.last_column)
    found = []
    for observed in OBSERVED:
        off = (getattr(draft, observed) - getattr(whole, observed))[columns]
        found.append((math.sqrt(float(np.mean(off**2))), draft.draft_error[observed]))
    return found


def test_a_draft_is_as_near_to_its_picture_as_it_says() -> None:
    random = np.random.default_rng(1)
    tried = 0
    while tried < amount(6, 50):
        scene, step = random_scene(random), int(random.choice([2, 3, 5, 9, 16]))
        try:
            found = errors(scene, step)
        except occ.ProjectionError:
            continue
        tried += 1
        for observed, (off, stated) in zip(OBSERVED, found, strict=True):
            assert off <= stated + 1e-9, (tried, step, observed, scene)


@pytest.mark.parametrize(
    "preset", ["phone-136us-real", pytest.param("tablet-61us-real", marks=pytest.mark.whole)]
)
@pytest.mark.parametrize("turn", [{}, {"roll": 0.15, "yaw": 0.2}])
def test_the_stated_error_of_a_real_cameras_draft_is_no_empty_one(
    preset: str, turn: dict[str, float]
) -> None:
    scene = occ.load_preset(preset).replace(**turn)
    scene = scene.replace(columns=600, readout_time=5 * scene.camera.readout_time)
    for (off, stated), most in zip(errors(scene, 5), (4.0, 20.0), strict=True):
        assert off <= stated <= most


def test_a_picture_and_a_draft_of_equal_rows_have_no_error() -> None:
    scene = occ.load_preset("phone-136us").replace(rows=600, columns=600)
    whole = occ.render(scene)
    assert whole.draft_error == {"profile": 0.0, "signal": 0.0}
    draft = occ.render(scene, tolerance=math.inf, rows_step=7)
    assert draft.draft_error == {"profile": 0.0, "signal": 0.0}
    np.testing.assert_array_equal(draft.signal, occ.render(scene, tolerance=math.inf).signal)


def test_fewer_rows_have_a_larger_error() -> None:
    scene = occ.load_preset("phone-136us-real").replace(columns=600)
    steps = (2, 6, 18)
    stated = [occ.render(scene, noise="reused", rows_step=step).draft_error for step in steps]
    for observed in OBSERVED:
        found = [errors[observed] for errors in stated]
        assert found == sorted(found)
