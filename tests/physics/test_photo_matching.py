"""Photos of known scenes are explained by these scenes."""

import numpy as np
import pytest
from photo_trials import MatchErrors, match_seed

pytestmark = pytest.mark.first

SAMPLE, WHOLE = range(1, 3), range(1, 11)
"""Photos in the test; tests/benchmarks/matching.py has hundreds."""


@pytest.fixture(scope="module")
def sample() -> list[MatchErrors]:
    """Match the photos that are tested every day."""
    return [match_seed(seed) for seed in SAMPLE]


@pytest.fixture(scope="module", params=["sample", pytest.param("whole", marks=pytest.mark.whole)])
def found(request: pytest.FixtureRequest, sample: list[MatchErrors]) -> list[MatchErrors]:
    """Match the sample, or all photos."""
    return (
        sample if request.param == "sample" else [*sample, *map(match_seed, WHOLE[len(SAMPLE) :])]
    )


def test_the_readout_time_comes_back_within_two_thousandths(found: list[MatchErrors]) -> None:
    errors = np.array([one.readout_error for one in found])
    assert np.median(errors) < 0.002
    # Nearly all of them are within that.
    assert np.mean(errors < 0.002) > 0.985


def test_long_exposures_are_found_within_a_twentieth(found: list[MatchErrors]) -> None:
    errors = np.array([one.exposure_error for one in found if one.exposure_in_chips > 0.5])
    # Half of them are expected; of ten there may be as few as three.
    assert len(errors) > len(found) // 4
    assert np.median(errors) < 0.05
    assert np.mean(errors < 0.05) > 0.97


def test_photos_that_cannot_be_explained_are_few_and_say_why(found: list[MatchErrors]) -> None:
    failures = [one.failure for one in found if one.failure]
    assert len(failures) <= 0.01 * len(found)
    assert all(failure.endswith(".") and len(failure) > 40 for failure in failures)


@pytest.mark.parametrize("index", range(3), ids=["readout_time", "exposure_time", "start_time"])
def test_the_uncertainties_are_neither_too_small_nor_too_large(
    found: list[MatchErrors], index: int
) -> None:
    deviations = np.array([one.deviations[index] for one in found if one.deviations])
    assert np.mean(deviations < 3.0) > 0.85
    # Unknown blur can look like a short exposure, so that the stated error includes a column of it,
    # which these sharp photos do not need.
    long = [
        one.deviations[index] for one in found if one.deviations and one.exposure_in_chips > 0.5
    ]
    assert np.median(long) > 0.02
