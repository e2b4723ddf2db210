"""Where a photo lies is within limits."""

import pytest

from occ_gui.values.placement import LARGEST_SCALE, LEAST_SCALE, Placement


@pytest.mark.parametrize(("scale", "kept"), [(0.0, LEAST_SCALE), (1e9, LARGEST_SCALE)])
def test_the_scale_stays_within_its_limits(scale: float, kept: float) -> None:
    assert Placement(1.0, 2.0, scale).within_limits() == Placement(1.0, 2.0, kept)
