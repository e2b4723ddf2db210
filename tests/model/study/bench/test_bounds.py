"""What theory says of a bench agrees with the exposure's filter, and no measurement exceeds it."""

import numpy as np
import pytest

from occ_model.errors import ParameterError
from occ_model.figures.bench import bench_drawing
from occ_model.results.bench import BenchRequest
from occ_model.study.bench.bench import bench, bench_bounds, bench_scene, bench_signal


def test_at_the_nulls_alternating_chips_leave_no_stripes() -> None:
    request = BenchRequest(payload_bits=64)
    nulls = bench_bounds(request).nulls
    assert nulls == (2.0, 4.0, 6.0, 8.0)
    swings = {}
    for exposure in (*nulls, 1.0, 3.0, 5.0):
        scene = bench_scene(request, "manchester", exposure).replace(pattern="01")
        swings[exposure] = float(np.ptp(bench_signal(scene, 300.0, np.random.default_rng(1))))
    for exposure, swing in swings.items():
        assert (swing < 1e-6) == (exposure in nulls)


def test_the_bound_falls_with_the_exposure_and_rises_with_the_ratio_and_the_pictures() -> None:
    bounds = bench_bounds(BenchRequest())
    (exposures, by_exposure), (ratios, by_ratio) = (
        bounds.most_bits[axis] for axis in ("exposure", "noise")
    )
    assert (exposures[0], exposures[-1], ratios[0], ratios[-1]) == (0.5, 8.0, 10.0, 30.0)
    assert (np.diff(by_exposure) < 0.0).all()
    assert (np.diff(by_ratio) > 0.0).all()
    fewer = bench_bounds(BenchRequest(rows=1728)).most_bits["noise"][1]
    np.testing.assert_allclose(np.array(fewer) * 2.0, by_ratio)


def test_no_decoder_carries_more_than_the_bound() -> None:
    request = BenchRequest(
        decoders=("threshold", "equalizer", "sequence"), exposures=(1.0, 4.0), decibels=(10.0,),
        bits=512,
    )  # fmt: skip
    bounds = bench_bounds(request)
    for point in bench(request):
        least = min(bounds.most_bits[point.axis][1])
        low, high = point.errors.bits_a_second_interval(30.0)
        assert low <= point.errors.bits_a_second(30.0) <= high <= 30.0 * least


def test_a_figure_of_more_pictures_than_can_be_read_out_is_refused() -> None:
    request = BenchRequest(exposures=(), decibels=())
    assert bench_drawing(request, (), 36.0).name == "bench"
    with pytest.raises(ParameterError, match=r"frames_a_second is 40\.0"):
        bench_drawing(request, (), 40.0)
