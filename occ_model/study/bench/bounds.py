"""What theory says of a bench: the nulls of the exposure, and the most bits a second."""

import numpy as np

from occ_model.results.bench import BenchBounds, BenchRequest
from occ_model.study.bench.bench import bench_scene
from occ_model.study.bit_error_rate import check_frame_rate
from occ_model.study.theory import gaussian_rate_bound

_PLACES = 61
"""Places of a curve of the bound."""

_NULL = 2.0
"""Exposures, in symbols, that collect as much of either of two chips that alternate."""


def bench_bounds(request: BenchRequest, frames_a_second: float) -> BenchBounds:
    """Compute what theory says along both axes of a request.

    The nulls are those of chips that alternate, the fastest wave of each line code: its frequency
    is f/2, and |sinc(t f / 2)| is nothing where the exposure lasts an even number of symbols. The
    most bits are :func:`occ_model.study.theory.gaussian_rate_bound`, which no scheme changes.

    Raises
    ------
    ParameterError
        A value is not allowed, or so many pictures cannot be read out in a second.
    """
    scheme = request.schemes[0]
    check_frame_rate(bench_scene(request, scheme), frames_a_second)

    def bound(exposure: float, decibels: float) -> float:
        scene = bench_scene(request, scheme, exposure)
        return gaussian_rate_bound(scene, 10.0 ** (decibels / 10.0), frames_a_second)

    exposures, ratios = _between(request.exposures), _between(request.decibels)
    longest = max(request.exposures, default=0.0)
    return BenchBounds(
        tuple(_NULL * number for number in range(1, int(longest / _NULL) + 1)),
        {
            "exposure": (exposures, tuple(bound(at, request.at_decibels) for at in exposures)),
            "noise": (ratios, tuple(bound(request.at_exposure, at) for at in ratios)),
        },
    )


def _between(values: tuple[float, ...]) -> tuple[float, ...]:
    """Return places from the least to the largest of some values."""
    if not values:
        return ()
    return tuple(np.linspace(min(values), max(values), _PLACES).tolist())
