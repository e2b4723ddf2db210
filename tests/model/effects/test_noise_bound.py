"""What noise does to the bounds of other effects."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
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


@dataclass(frozen=True)
class Constant:
    """Noise of one standard deviation at every level."""

    deviation: float
    name: str = "constant"

    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        return np.full(np.shape(values), self.deviation)


PLACES = np.linspace(-9.0, 9.0, 20_001)
DENSITY = np.exp(-0.5 * PLACES**2) / math.sqrt(2.0 * math.pi) * (PLACES[1] - PLACES[0])


def shift(level: float, deviation: float) -> float:
    """How far cutting off at black and white moves the mean of a noisy pixel, by its integral."""
    return float(np.clip(level + deviation * PLACES, 0.0, WHITE) @ DENSITY) - level


@pytest.mark.parametrize("deviations", [(20.0,), (150.0,), (400.0,), (3.0, 30.0), (90.0, 100.0)])
def test_noise_moves_a_mean_over_many_rows_by_what_is_cut_off_and_no_more(
    deviations: tuple[float, ...],
) -> None:
    """White makes up for black; what other noise would cut off without this one is not counted."""
    view = paper_view_of(occ.load_preset("phone-136us").replace(rows=16, columns=40))
    view = replace(view, region=Region(0, 10**8, 0, 40))
    noises = [Constant(one, str(one)) for one in deviations]
    bounds = NoiseBounds(noises, view, moves_light=True).bounds("profile")  # type: ignore[arg-type]

    def largest(own: float, levels: list[float]) -> float:
        everything = math.hypot(*deviations)
        others = math.sqrt(everything**2 - own**2)
        return max(
            max(abs(shift(level, own)), abs(shift(level, everything) - shift(level, others)))
            for level in levels
        )

    for own in deviations:
        bound = bounds[str(own)]
        assert bound >= largest(own, view.levels.tolist()[:: len(view.levels) // 20]) - 1e-3
        assert bound <= largest(own, np.linspace(0.0, WHITE, 52).tolist()) + 1e-2
