"""The axes of a map are numbered by round values, wherever its cells are."""

import numpy as np
import pytest
from matplotlib.axis import Axis
from matplotlib.figure import Figure

import occ_model as occ
from occ_model.figures.sweep import sweep_drawing
from occ_model.results.sweep import SweepTable

FREQUENCIES = np.geomspace(0.97e3, 31e3, 13).tolist()
EXPOSURES = np.linspace(33e-6, 97e-6, 11).tolist()


@pytest.fixture(scope="module")
def table() -> SweepTable:
    """Sweep over axes that do not fall on round values, the rates being of no interest."""
    scene = occ.load_preset("phone-68us")
    axes = {"switching_frequency": FREQUENCIES, "exposure_time": EXPOSURES}
    return occ.sweep(scene, axes, images=1)


def values_at(axis: Axis, cells: list[float]) -> dict[float, float]:
    """Give for every label the value that its place among the cells stands for."""
    numbers = np.arange(len(cells), dtype=np.float64)
    return {
        float(tick.get_text()): float(np.interp(place, numbers, cells))
        for tick, place in zip(axis.get_ticklabels(), axis.get_ticklocs(), strict=True)
    }


def drawn(table: SweepTable) -> Figure:
    return sweep_drawing(table).draw()


def test_numbers_are_round_and_stand_where_their_values_are(table: SweepTable) -> None:
    ax = drawn(table).axes[0]
    kilohertz = values_at(ax.xaxis, np.log(np.array(FREQUENCIES) / 1e3).tolist())
    assert list(kilohertz) == [1.0, 2.0, 5.0, 10.0, 20.0]
    assert np.exp(list(kilohertz.values())) == pytest.approx(list(kilohertz), rel=1e-9)
    microseconds = values_at(ax.yaxis, (np.array(EXPOSURES) * 1e6).tolist())
    assert list(microseconds) == [40.0, 50.0, 60.0, 70.0, 80.0, 90.0]
    assert list(microseconds.values()) == pytest.approx(list(microseconds), rel=1e-9)
