"""The benchmark measures what it states, and agrees with closed forms."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.errors import ParameterError
from occ_model.figures.bench import bench_drawing
from occ_model.receiver.decode import decode
from occ_model.results.bit_errors import HEADER, BenchRequest, table_rows
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.study.bench.bench import bench, bench_bounds, bench_scene, bench_signal

SMALL = BenchRequest(
    decoders=("threshold", "equalizer", "sequence"),
    exposures=(0.5, 4.0),
    decibels=(30.0,),
    payload_bits=64,
    bits=128,
)


@pytest.mark.parametrize("rows", [4.0, 5.0, 7.0])
def test_a_symbol_lasts_as_many_rows_as_asked(rows: float) -> None:
    scene = bench_scene(BenchRequest(rows_a_symbol=rows), "manchester", 3.0)
    period = scene.transmitter.switching_period
    assert period / scene.camera.readout_time == pytest.approx(rows)
    assert scene.camera.exposure_time / period == pytest.approx(3.0)


@pytest.mark.parametrize("decibels", [5.0, 20.0])
def test_the_noise_variance_is_the_chips_variance_divided_by_the_ratio(decibels: float) -> None:
    scene = bench_scene(BenchRequest(payload_bits=64), "manchester")
    noise = bench_signal(scene, decibels, np.random.default_rng(1))
    clean = bench_signal(scene, 200.0, np.random.default_rng(1))
    swing = float(np.ptp(clean))  # an exposure of one chip still shows whole chips
    expected = 0.25 * swing**2 / 10.0 ** (decibels / 10.0)
    assert float(np.var(noise - clean)) == pytest.approx(expected, rel=0.1)


def test_for_exposures_above_two_symbols_only_the_new_detectors_read() -> None:
    points = {(p.errors.decoder, p.exposure, p.axis): p for p in bench(SMALL)}
    for decoder in SMALL.decoders:
        assert points[decoder, 0.5, "exposure"].errors.errors == 0
    for decoder in ("equalizer", "sequence"):
        assert points[decoder, 4.0, "exposure"].errors.errors == 0
        assert points[decoder, 4.0, "exposure"].note == ""
    beyond = points["threshold", 4.0, "exposure"]
    assert beyond.errors.rate > 0.3
    assert beyond.note.endswith(".")


def test_both_axes_meet_in_one_measurement() -> None:
    found = bench(SMALL)
    by_axis = {
        axis: [p.errors for p in found if (p.axis, p.exposure, p.decibels) == (axis, 4.0, 30.0)]
        for axis in ("exposure", "noise")
    }
    assert by_axis["exposure"] == by_axis["noise"]


def test_a_row_of_the_table_has_every_column() -> None:
    rows = table_rows(bench(SMALL), 30.0)
    assert len(rows) == 3 * 3
    assert {len(row) for row in rows} == {len(HEADER)}
    assert all(0.0 <= row[8] <= row[7] <= row[9] <= 1.0 for row in rows)  # type: ignore[operator]


def test_progress_counts_up_to_all_points() -> None:
    seen: list[tuple[int, int]] = []
    bench(SMALL, lambda done, of: seen.append((done, of)))
    assert seen == [(0, 3), (1, 3), (2, 3), (3, 3)]


def test_the_bench_and_the_bit_error_rate_count_the_same_errors() -> None:
    # Two ways to answer the same question, for a scene without noise that every decoder reads.
    scene = bench_scene(BenchRequest(payload_bits=64), "manchester").replace(rows=40, distance=0.3)
    by_scene = occ.bit_error_rate(scene, "sequence", 128)
    by_bench = bench(BenchRequest(decoders=("sequence",), exposures=(1.0,), decibels=(), bits=128,
                                  payload_bits=64, at_decibels=60.0))  # fmt: skip
    assert by_scene.rate == by_bench[0].errors.rate == 0.0
    assert (by_scene.low, by_scene.high) == (by_bench[0].errors.low, by_bench[0].errors.high)


def test_rejected_bits_count_in_the_rate_but_not_as_payload_per_second(
    offer_decoders: Callable[..., None],
) -> None:
    def doubt(signal: FloatArray, scene: Scene) -> DecodeResult:
        return replace(decode(signal, scene), failure="The chips are not certain enough.")

    offer_decoders(doubting=doubt)
    one = BenchRequest(decoders=("doubting",), exposures=(0.5,), decibels=(30.0,),
                       payload_bits=64, bits=128)  # fmt: skip
    found = bench(one)[0].errors
    assert found.errors == 0
    assert found.pictures_right == 0
    assert found.bits_a_second() == 0.0


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


def test_a_figure_with_more_pictures_per_second_than_can_be_read_out_is_refused() -> None:
    request = BenchRequest(exposures=(), decibels=())
    assert bench_drawing(request, (), 36.0).name == "bench"
    with pytest.raises(ParameterError, match=r"frames_a_second is 40\.0"):
        bench_drawing(request, (), 40.0)
