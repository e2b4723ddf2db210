"""The paper's results, as the reproduction must show them."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.commands.figures import detection_sentence
from occ_model.results.sweep import SweepTable
from occ_model.results.sweep_csv import SweepRow
from occ_model.scene.scene import Scene
from occ_model.study.paper_grid import (
    DEVICES,
    DISTANCES,
    FREQUENCIES,
    find_detection_limit,
    grid_request,
)
from occ_model.study.sweep.sweep import run_sweep
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.scheme import packet_length

TRIED = amount((0.6, 1.2, 1.6, 2.0), DISTANCES)
"""The paper's distances at which rates are measured."""


@cache
def grid(preset: str, decoder: str) -> SweepTable:
    # Fewer images are enough for the decoder that is not the paper's.
    request = grid_request(preset, [decoder], amount(2, 5) if decoder == "threshold" else 2)
    return run_sweep(replace(request, axes={**request.axes, "distance": TRIED}))


def scene_of(preset: str, row: SweepRow) -> Scene:
    return occ.load_preset(preset).replace(**row.point)


def two_headers_fit(preset: str, row: SweepRow) -> bool:
    """Return whether two whole headers are in the panel's image for any start of a packet."""
    scene = scene_of(preset, row)
    panel = np.clip(occ.panel_corners(scene)[:, 0], 0, scene.camera.columns - 1)
    seconds = float(np.ptp(panel)) * scene.camera.readout_time
    chips = seconds * scene.transmitter.switching_frequency
    return chips >= 2 * packet_length(10) + len(HEADER)


def rates(preset: str, low: float, high: float, decoder: str = "threshold") -> list[float | None]:
    found = [
        row.rate
        for row in grid(preset, decoder).rows
        if low <= float(row.point["switching_frequency"]) <= high and two_headers_fit(preset, row)
    ]
    assert found
    return found


def test_phone_at_68_us_reads_everything_from_4_to_20_khz() -> None:
    assert set(rates("phone-68us", 4e3, 20e3)) == {100.0}


_LAST = [("phone-136us", 14e3), ("tablet-122us", 14e3)]
"""The last step of 2 kHz that is read. The paper's tablet ceases at 16 kHz."""


@pytest.mark.parametrize(("preset", "last"), _LAST)
def test_twice_the_exposure_is_read_up_to_the_papers_limit(preset: str, last: float) -> None:
    exposure = occ.load_preset(preset).camera.exposure_time
    assert exposure > 1 / last
    assert set(rates(preset, 4e3, last - 2e3)) == {100.0}
    at_last = [rate for rate in rates(preset, last, last) if rate is not None]
    assert np.mean(at_last) >= 90.0
    assert set(rates(preset, last + 2e3, 20e3)) == {0.0}


@pytest.mark.parametrize(("preset", "paper"), [("phone-136us", 14e3), ("tablet-122us", 16e3)])
def test_detection_ceases_within_two_hundredths_of_the_papers_frequency(
    preset: str, paper: float
) -> None:
    scene = occ.load_preset(preset)
    below, above = (
        occ.success_rate(scene.replace(switching_frequency=paper * factor), images=4)
        for factor in (0.98, 1.02)
    )
    assert (below, above) == (100.0, 0.0)


@pytest.mark.parametrize(("preset", "last"), _LAST)
def test_the_last_step_that_is_read_is_stated(preset: str, last: float) -> None:
    table = grid(preset, "threshold")
    assert find_detection_limit(table, "threshold") == (last, last + 2e3)
    assert detection_sentence(preset, table) == (
        f"{preset}: of the frequencies tried, {last / 1e3:.0f} kHz is the last that is read at "
        f"some distance, {last / 1e3 + 2:.0f} kHz the first at none"
    )


@pytest.mark.parametrize(
    ("preset", "last"), [("phone-136us-real", 12e3), ("tablet-122us-real", 14e3)]
)
def test_a_real_lens_ends_detection_where_the_experiment_ended(preset: str, last: float) -> None:
    scene = occ.load_preset(preset).replace(switching_frequency=last, distance=1.2)
    assert occ.success_rate(scene, 1) == 100.0
    beyond = scene.replace(switching_frequency=last + 2e3)
    assert occ.success_rate(beyond, 1) == 0.0
    # A single threshold cannot follow the fall-off of light across the panel.
    level = {"vignetting": False}
    if preset.startswith("phone"):
        beyond = scene.replace(switching_frequency=13.9e3)
        assert occ.success_rate(beyond, 4, tolerance=0.0) < 100.0
        assert occ.success_rate(beyond, 4, tolerance=0.0, force=level) == 100.0


@pytest.mark.parametrize("preset", ["phone-68us", "tablet-61us"])
def test_detection_goes_on_to_20_khz_at_the_lowest_exposure(preset: str) -> None:
    ends = find_detection_limit(grid(preset, "threshold"), "threshold")
    assert ends == (FREQUENCIES[-1], None)


@pytest.mark.parametrize("preset", DEVICES["tablet"])
def test_tablet_at_2_khz_loses_codes_with_distance(preset: str) -> None:
    by_distance = grid(preset, "threshold").rates()[FREQUENCIES.index(2e3)].tolist()
    assert by_distance[0] == 100.0
    assert by_distance[-1] == 0.0
    # With few images a point, single points may deviate, but not the trend.
    assert np.corrcoef(TRIED, by_distance)[0, 1] < -0.8


def test_matched_decoder_reads_every_point_where_a_packet_fits() -> None:
    assert set(rates("phone-136us", 4e3, 20e3, "matched")) == {100.0}


def test_a_point_is_measured_again_by_its_own_seed() -> None:
    request = grid_request("tablet-61us", ["threshold"], 3, 7)
    rows = run_sweep(replace(request, axes={**request.axes, "switching_frequency": (2e3,)})).rows
    row = next(row for row in rows if row.rate is not None and 0.0 < row.rate < 100.0)
    scene = scene_of("tablet-61us", row)
    assert occ.success_rate(scene, 3, row.decoder, 7) == row.rate


def test_the_grid_is_the_papers() -> None:
    assert tuple(range(2000, 20001, 2000)) == FREQUENCIES
    assert DISTANCES == (0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0)
    request = grid_request("tablet-61us", ["threshold"])
    assert dict(request.axes) == {"switching_frequency": FREQUENCIES, "distance": DISTANCES}
    assert request.settings.images == 5
