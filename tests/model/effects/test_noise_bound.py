"""What noise does to the bounds of other effects."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.effects.noise_bound import NoiseBounds
from occ_model.effects.paper_view import paper_view_of
from occ_model.results import Region
from occ_model.scene.scene import Scene


@dataclass(frozen=True)
class Proportional:
    """Noise whose standard deviation is some times the level."""

    times: float
    name: str = "proportional"

    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        return self.times * np.asarray(values)


@pytest.mark.parametrize("times", [0.1, 1.0, 20.0])
@pytest.mark.parametrize("rows", [1, 2, 5])
def test_noise_that_grows_with_the_light_enlarges_a_change_by_no_more_than_its_bound(
    times: float, rows: int
) -> None:
    """One level more makes k levels more of noise, of which a mean keeps k over root n."""
    view = paper_view_of(occ.load_preset("phone-136us").replace(rows=16, columns=40))
    view = replace(view, region=Region(0, rows, 0, 40))
    bounds = NoiseBounds([Proportional(times)], view, moves_light=False)  # type: ignore[list-item]
    assert bounds.amplification("image") == pytest.approx(math.hypot(1.0, times))
    # As long as nothing is cut off, the change of a mean is 1 + k Z / sqrt(n), Z normal.
    assert bounds.amplification("profile") >= math.hypot(1.0, times / math.sqrt(rows))
    # At black half of the noise is cut off, which moves the mean by k phi(0).
    assert bounds.amplification("profile") >= 1.0 + times / math.sqrt(2.0 * math.pi)
