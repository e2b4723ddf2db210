"""What is sure of photographs by a camera that the model was not made from holds."""

import numpy as np
import pytest
from photo_world.foreign import foreign
from photo_world.trials import foreign_trial_of


@pytest.mark.parametrize("seed", [91000, 91001, 91007])
def test_a_photographs_stripes_repeat_after_the_chips_that_are_told(seed: int) -> None:
    """Where the truth is told wrongly, a period off by half a column no longer fits."""
    drawn = foreign(seed)
    profile = drawn.image.mean(axis=0)
    columns = np.arange(len(profile))
    period = len(drawn.chips) * drawn.chip
    several = int(0.6 * len(profile) / period)

    def repeats(by: float) -> float:
        later = np.interp(columns + several * by, columns, profile)
        inner = columns + several * by < len(profile) - 1
        return float(np.corrcoef(profile[inner], later[inner])[0, 1])

    tried = period * (1.0 + np.linspace(-0.02, 0.02, 41))
    best = tried[np.argmax([repeats(one) for one in tried])]
    assert several * abs(best - period) < 1.0


@pytest.mark.parametrize("seed", [91003, pytest.param(91005, marks=pytest.mark.whole)])
def test_a_sure_readout_time_is_within_four_stated_deviations(seed: int) -> None:
    found = foreign_trial_of(seed)
    assert found.is_sure
    assert abs(found.readout) < 4.0 * found.readout_deviation
    assert found.readout_deviation < 1e-3
