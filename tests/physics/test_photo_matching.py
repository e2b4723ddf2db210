"""Photos of known scenes are explained by the scenes they were taken of."""

import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

import numpy as np
import pytest
from simulated_photos import random_scene, take

import occ_model as occ

PHOTOS = int(os.environ.get("OCC_PHOTOS", "500"))


@dataclass(frozen=True)
class Found:
    """How far off one photo's match is."""

    seed: int
    exposure_in_chips: float
    failure: str = ""
    readout: float = np.inf
    exposure: float = np.inf
    deviations: tuple[float, ...] = ()


def round_trip(seed: int) -> Found:
    """Simulate a photo and match it, told what was sent and how fast, and nothing else."""
    scene = random_scene(seed)
    camera, frequency = scene.camera, scene.transmitter.switching_frequency
    in_chips = camera.exposure_time * frequency
    told = scene.replace(readout_time=1e-6, exposure_time=1.0, start_time=0.0)
    try:
        match = occ.match_photo(take(scene, seed), told)
    except occ.MatchError as why:
        return Found(seed, in_chips, str(why))
    period = len(match.pattern) / frequency
    late = (match.start_time - scene.model.start_time + period / 2) % period - period / 2
    off = {
        "readout_time": match.readout_time - camera.readout_time,
        "exposure_time": match.exposure_time - camera.exposure_time,
        "start_time": late,
    }
    return Found(
        seed,
        in_chips,
        readout=abs(off["readout_time"]) / camera.readout_time,
        exposure=abs(off["exposure_time"]) / camera.exposure_time,
        deviations=tuple(abs(off[name]) / match.uncertainties[name] for name in off),
    )


@pytest.fixture(scope="module")
def found() -> Iterator[list[Found]]:
    # Processes that begin anew: a fork of one that has run Qt may hang.
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        yield list(pool.map(round_trip, range(PHOTOS), chunksize=5))


def test_the_readout_time_comes_back_within_two_thousandths(found: list[Found]) -> None:
    errors = np.array([one.readout for one in found])
    assert np.median(errors) < 0.002
    # Far better than the median must be: nearly all of them do.
    assert np.mean(errors < 0.002) > 0.97


def test_an_exposure_over_half_a_chip_comes_back_within_a_twentieth(found: list[Found]) -> None:
    errors = np.array([one.exposure for one in found if one.exposure_in_chips > 0.5])
    assert len(errors) > PHOTOS // 3
    assert np.median(errors) < 0.05
    assert np.mean(errors < 0.05) > 0.9


def test_photos_that_cannot_be_explained_are_few_and_say_why(found: list[Found]) -> None:
    failures = [one.failure for one in found if one.failure]
    assert len(failures) <= 0.02 * PHOTOS
    assert all(failure.endswith(".") and len(failure) > 40 for failure in failures)


@pytest.mark.parametrize("index", range(3), ids=["readout_time", "exposure_time", "start_time"])
def test_the_uncertainties_are_neither_boasting_nor_empty(found: list[Found], index: int) -> None:
    deviations = np.array([one.deviations[index] for one in found if one.deviations])
    assert np.mean(deviations < 3.0) > 0.85
    assert np.median(deviations) > 0.02
