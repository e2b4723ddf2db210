"""The pane that the manual shows as an example is one, and shows what a picture's reading has."""

from typing import Any

import numpy as np
import pytest
from documents import FOLDER, blocks, text_of
from gui.kinds import SnapshotOf
from gui.pane_bench import PaneBench
from pytestqt.qtbot import QtBot

from occ_gui.shell.feature import Feature
from occ_gui.shell.results import of_snapshot


@pytest.fixture
def example() -> Feature[Any]:
    *_, code = blocks(text_of(FOLDER / "developers.md"), "python")
    names: dict[str, Any] = {"__name__": "example"}
    exec(compile(code, "developers.md", "exec"), names)
    feature = names["run_lengths"]()
    assert isinstance(feature, Feature)
    return feature


def test_the_pane_of_the_manual_shows_the_stripes_of_each_picture(
    qtbot: QtBot, example: Feature[Any], snapshot_of: SnapshotOf
) -> None:
    found = snapshot_of()
    bench = PaneBench(qtbot, found.scene)
    pane = bench.add(example)
    assert [curve.getData()[0] for curve in pane.curves] == [None, None]
    bench.results_store.show_snapshot(found)
    assert found.results["threshold"].histograms is not None
    for curve, histogram in zip(pane.curves, found.results["threshold"].histograms, strict=True):
        assert np.array_equal(curve.getData()[1], histogram.counts)
    bench.results_store.show_snapshot(snapshot_of(switching_frequency=500.0, exposure_time=1e-3))
    assert pane.made_of == {pane.plot: of_snapshot}
