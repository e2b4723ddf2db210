"""Theoretical bounds of a bench: nulls of the exposure, and maximum bits of a picture."""

import numpy as np

from occ_model.parallel.job import Heartbeat
from occ_model.results.bench import BenchBounds, BenchRequest
from occ_model.study.bench.bench import bench_scene
from occ_model.study.theory import gaussian_rate_bound

_CURVE_POINTS = 31

_NULL_EXPOSURE = 2.0  # first null of alternating chips, in symbols; the others are its multiples


def bench_bounds(request: BenchRequest, heartbeat: Heartbeat = lambda: None) -> BenchBounds:
    """Compute the theoretical bounds along both axes of a request.

    The nulls are those of alternating chips, the fastest wave of each line code: its frequency is
    f/2, and |sinc(t f / 2)| vanishes where the exposure lasts an even number of symbols. The most
    bits are :func:`occ_model.study.theory.gaussian_rate_bound`, which no scheme changes.
    """

    def bound(exposure: float, decibels: float) -> float:
        heartbeat()
        scene = bench_scene(request, request.schemes[0], exposure)
        return gaussian_rate_bound(scene, 10.0 ** (decibels / 10.0), frames_a_second=1.0)

    exposures, ratios = _between(request.exposures), _between(request.decibels)
    longest = max(request.exposures, default=0.0)
    return BenchBounds(
        tuple(_NULL_EXPOSURE * number for number in range(1, int(longest / _NULL_EXPOSURE) + 1)),
        {
            "exposure": (exposures, tuple(bound(at, request.at_decibels) for at in exposures)),
            "noise": (ratios, tuple(bound(request.at_exposure, at) for at in ratios)),
        },
    )


def _between(values: tuple[float, ...]) -> tuple[float, ...]:
    """Return places from the least to the largest of some values."""
    if not values:
        return ()
    return tuple(np.linspace(min(values), max(values), _CURVE_POINTS).tolist())
