"""Laws of the sweep: each point is independent of the others."""

import os
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import pytest
from model.study.sweep.conftest import AXES, BOTH

import occ_model as occ
from occ_model.parallel import process_pool
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_request import MOST_AXES, RateSettings
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.study.confidence import interval_of_pictures
from occ_model.study.success_rate import right_bits_of_images
from occ_model.study.sweep.request_check import build_request


def test_every_point_can_be_measured_again_by_itself(scene: Scene, table: SweepTable) -> None:
    assert len(table.rows) == 4 * 3 * 2
    for row in table.rows:
        alone = occ.success_rate(scene.replace(**row.point), 3, row.decoder, 7)
        assert alone == row.rate
    assert len({row.rate for row in table.rows}) > 2  # the table has different numbers


def test_rates_are_placed_by_their_axes(table: SweepTable) -> None:
    for decoder in BOTH:
        rates, (low, high) = table.rates(decoder), table.intervals(decoder)
        assert rates.shape == low.shape == high.shape == (4, 3)
        for row in table.rows:
            if row.decoder == decoder:
                place = tuple(AXES[name].index(float(row.point[name])) for name in AXES)
                pictures = interval_of_pictures(row.right, row.sent, 3)
                assert (rates[place], low[place], high[place]) == (row.rate, row.low, row.high)
                assert (row.low, row.high) == pictures
    with pytest.raises(occ.ParameterError, match="decoder is 'psychic'; allowed in this table"):
        table.rates("psychic")


def test_the_order_of_axes_only_transposes_the_table(scene: Scene, table: SweepTable) -> None:
    turned = occ.sweep(scene, dict(reversed(AXES.items())), 3, BOTH, 7)
    for decoder in BOTH:
        np.testing.assert_array_equal(turned.rates(decoder).T, table.rates(decoder))
    assert turned != table


def test_any_kind_of_parameter_can_be_varied(scene: Scene) -> None:
    axes: dict[str, Any] = {
        "enhancement": np.array(["equalization", "none"]),
        "bits": np.array([4, 10]),
        "code": (3, 9),
        "yaw": [0.0],
    }
    found = occ.sweep(scene, axes, 1)
    assert found.sent.tolist() == [[[[4], [4]], [[10], [10]]]] * 2
    assert {type(value) for values in found.axes.values() for value in values} == {str, int, float}
    for row in found.rows:
        assert occ.success_rate(scene.replace(**row.point), 1) == row.rate


def test_each_point_is_visited_once_with_pictures_that_differ_in_light_alone_together(
    scene: Scene,
) -> None:
    axes = {"switching_frequency": [4e3, 5e3, 6e3], "distance": [1.0, 2.0], "bits": [4, 10]}
    request = build_request(scene, axes, RateSettings(1, BOTH))
    order = list(request.in_order_of_work())
    assert sorted(order) == list(range(12))
    points = [request.values(index) for index in order]
    assert [point["bits"] for point in points] == [4] * 6 + [10] * 6
    assert [point["distance"] for point in points] == 2 * ([1.0] * 3 + [2.0] * 3)


def test_a_scene_that_the_model_refuses_is_a_row_with_a_sentence(scene: Scene) -> None:
    axes = {"distance": [0.1, 1.0], "yaw": [0.0, 1.2]}
    found = occ.sweep(scene.replace(rows=60, panel_height=0.01), axes, 1)
    refused = found.rows[1]
    assert refused.rate is refused.low is refused.high is None
    assert refused.note.startswith("With these angles at a distance of 0.1 m, part of the panel")
    assert np.isnan(found.rates()).tolist() == [[False, True], [False, False]]
    assert [row.note for row in found.rows if row is not refused].count("") == 3
    bits = occ.sweep(scene, {"bits": [4, 10], "code": [900]}, 1)
    assert bits.rows[0].note == "code is 900; allowed with 4 bits: 0 to 15."
    assert bits.rows[1].rate == 100.0


def test_a_refused_sweep_leaves_no_file_of_results(scene: Scene, tmp_path: Path) -> None:
    wrong: dict[str, list[float | str]] = {"distnce": [1.0], "pattern": ["", "01"]}
    for name, words in (("distnce", "did you mean distance"), ("pattern", "cannot be varied")):
        with pytest.raises(occ.ParameterError, match=words):
            occ.sweep(scene, {name: wrong[name]}, results=tmp_path / "r.csv")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("jobs", "points", "cores", "started"),
    [(1024, 100, 2, 8), (3, 100, 2, 3), (6, 4, 64, 4), (1, 4, 2, 1), (8, 1, 2, 1), (5, 9, None, 4)],
)
def test_no_more_processes_are_started_than_have_points_or_cores(
    monkeypatch: pytest.MonkeyPatch, jobs: int, points: int, cores: int | None, started: int
) -> None:
    counts: list[int] = []

    class Stop(Exception):  # noqa: N818
        pass

    def start(number: int, _preload: str) -> NoReturn:
        counts.append(number)
        raise Stop

    monkeypatch.setattr(os, "cpu_count", lambda: cores)
    monkeypatch.setattr(process_pool, "ProcessPool", start)
    axes = {"iso": [100.0 + place for place in range(points)]}
    with suppress(Stop):
        occ.sweep(occ.load_preset("phone-68us").replace(rows=60), axes, 1, jobs=jobs)
    assert counts == ([started] if started > 1 else [])


def test_as_many_parameters_are_varied_as_an_array_has_axes() -> None:
    start = occ.load_preset("phone-68us").replace(rows=60)
    varied = (name for name, declared in PARAMETERS.items() if declared.is_of("code"))
    axes = {name: [start.value(name)] for name in varied if name != "pattern"}
    with pytest.raises(occ.ParameterError, match=f"{len(axes)} parameters .*; allowed: at most 31"):
        occ.sweep(start, axes, 1)
    most = dict(list(axes.items())[:MOST_AXES])
    assert occ.sweep(start, most, 1).rates().shape == (1,) * MOST_AXES


def test_bits_per_second_count_the_images_of_which_every_bit_is_read() -> None:
    scene = occ.load_preset("phone-136us").replace(switching_frequency=3.3e3)
    table = occ.sweep(scene, {"distance": [0.6, 1.2]}, images=6, frames_a_second=20.0)
    for place, distance in enumerate((0.6, 1.2)):
        at = scene.replace(distance=distance)
        counts = [count for (count,) in right_bits_of_images(at, RateSettings(6, ("threshold",)))]
        whole = sum(count == 10 for count in counts)
        assert table.bits_a_second()[place] == pytest.approx(20.0 * 10 * whole / 6)
    assert 0.0 < table.bits_a_second()[1] < table.bits_a_second()[0] == 200.0


def test_pictures_per_second_are_limited_by_the_readout() -> None:
    scene = occ.load_preset("phone-68us").replace(rows=100)
    table = occ.sweep(scene, {"readout_time": [8e-6, 20e-6]}, images=1, frames_a_second=30.0)
    columns = scene.camera.columns
    assert table.bits_a_second() == pytest.approx([300.0, 10.0 / (columns * 20e-6)])
