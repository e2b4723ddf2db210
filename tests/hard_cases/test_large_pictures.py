"""Pictures and blurs that would fill the memory."""

import tracemalloc

import numpy as np
import pytest

import occ_model as occ
from hard_cases.poses_and_lenses import GEOMETRY
from occ_model.camera.projection import MAX_PIXELS
from occ_model.effects.optics_effects import blur_of
from occ_model.scene.scene import Scene

HUGE: dict[str, dict[str, int]] = {
    # 1e11 pixels, each number within its range.
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
