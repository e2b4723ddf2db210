"""The interval of an end holds it, and what refutes a rate does so rarely where it is reached."""

import math
from collections.abc import Callable, Sequence
from statistics import NormalDist

import numpy as np
import pytest
from amount import amount

from occ_model.study.confidence import count_until_refuted
from occ_model.study.range_end import Bracket, EndSearch, images_to_prove
from occ_model.study.value_images import FEW_IMAGES
from occ_model.study.working_range import STEP


@pytest.mark.parametrize("rate", [50.0, 90.0, 99.0, 99.5])
def test_no_more_images_are_requested_than_prove_a_rate(rate: float) -> None:
    """Whatever is lost more often than allowed would lose one of them with 95 %."""
    images = images_to_prove(rate)
    assert (rate / 100.0) ** images <= 0.05 < (rate / 100.0) ** (images - 1)


def logistic(width: float) -> Callable[[float], float]:
    """Return the fraction that is lost by the logarithm of the value, 1 % of it at 0."""
    return lambda at: 1.0 / (1.0 + 99.0 * math.exp(min(-at / width, 700.0)))


LOSSES: dict[str, Callable[[float], float]] = {
    "steep": logistic(5e-4),
    "gradual": logistic(0.02),
    "straight": lambda at: min(max(0.01 + 2.0 * at, 0.0), 1.0),
    "normal": lambda at: NormalDist().cdf(NormalDist().inv_cdf(0.01) + at / 0.02),
    "half of them at once": lambda at: 0.5 * (at >= 0.0),
    "shoulder": lambda at: 1.0 if at > 0.01 else 0.03 * (at >= 0.0),
    "sudden, in part": lambda at: 0.0 if at < -0.001 else min(0.01 + 10.0 * max(at, 0.0), 0.3),
}


@pytest.mark.parametrize("name", LOSSES)
@pytest.mark.parametrize("inwards", [1.0, -1.0])
def test_the_interval_of_an_end_contains_it_in_95_of_100_searches(
    name: str, inwards: float
) -> None:
    """However losses set in; the last has a rate of 99 % exactly over a tenth of a percent."""
    loss, studies = LOSSES[name], amount(60, 400)
    held = sought = 0
    for study in range(studies):
        random = np.random.default_rng([study, 20_261, inwards > 0.0])

        def measure(
            values: Sequence[float], images: int, random: np.random.Generator = random
        ) -> list[list[float]]:
            lost = [loss(-inwards * math.log(value / 1e4)) for value in values]
            return [(random.random(images) < each).astype(float).tolist() for each in lost]

        def at(place: float) -> float:
            return 1e4 * math.exp(-inwards * place)

        place = -0.6 + random.uniform(0.0, math.log(STEP))
        while not any(measure([at(place + math.log(STEP))], FEW_IMAGES)[0]):
            place += math.log(STEP)
        bracket = Bracket(at(place), at(place + math.log(STEP)), at(-0.6), at(0.6))
        found = EndSearch(measure, 99.0, 20).find(bracket)
        if found is None:
            continue
        first, last = sorted(found.interval)
        sought += 1
        held += first <= 1e4 <= last * (1.0 + 1e-12)
    assert sought >= 0.95 * studies
    assert held >= 0.95 * sought - 2.5 * math.sqrt(0.95 * 0.05 * sought)


def test_a_rate_that_is_reached_is_rejected_in_at_most_one_of_forty_studies() -> None:
    random = np.random.default_rng(4711)

    def count_refuting_images(rate: float, studies: int) -> list[int]:
        """Return how many images each study took that rejects 99 %."""
        read = (np.where(random.random(200) < rate, 10, 0).tolist() for _ in range(studies))
        found = [count_until_refuted(counts, 10, 0.99) for counts in read]
        return [len(one) for one in found if one is not None]

    studies = amount(400, 2000)
    most = studies * 0.025
    assert 0.1 * most < len(count_refuting_images(0.99, studies)) < most + 3.0 * math.sqrt(most)
    assert len(count_refuting_images(0.95, 200)) > 140
    assert np.median(count_refuting_images(0.5, 200)) <= 4  # half of their bits are missing


def test_that_all_bits_are_read_is_refuted_by_the_first_wrong_bit() -> None:
    assert count_until_refuted([10, 10, 9, 10], 10, 1.0) == [10, 10, 9]
    assert count_until_refuted([10] * 60, 10, 1.0) is None
