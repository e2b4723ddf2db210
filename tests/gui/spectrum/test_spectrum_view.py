"""The pane of the spectrum shows the profile's frequencies and warns of lost light."""

import numpy as np
import pytest
from gui.kinds import SnapshotOf, show_widget
from pytestqt.qtbot import QtBot

from occ_gui.simulation.snapshot import Snapshot
from occ_gui.spectrum.pane import SpectrumPane
from occ_gui.spectrum.spectrum_view import SpectrumView


@pytest.fixture
def view(qtbot: QtBot) -> SpectrumView:
    return show_widget(qtbot, SpectrumView(), 500, 400)


def show(view: SpectrumView, snapshot: Snapshot) -> None:
    SpectrumPane(view).show_part(snapshot)


def test_the_strongest_line_of_an_alternating_pattern_is_half_its_frequency(
    view: SpectrumView, snapshot_of: SnapshotOf
) -> None:
    show(view, snapshot_of(pattern="10", switching_frequency=8e3, exposure_time=50e-6))
    frequencies, amplitudes = view.amplitudes.getData()
    assert frequencies[amplitudes.argmax()] == pytest.approx(4.0, rel=0.05)
    (first, last), (_, top) = view.spectrum.viewRange()
    assert (first, last) == pytest.approx((0.0, frequencies[-1]))
    assert view.response.getData()[1].max() == pytest.approx(amplitudes.max())
    assert amplitudes.max() < top
    assert "first zero of the exposure's response: 20 kHz" in view.spectrum.accessibleDescription()
    assert len(view.zeros) == 3
    show(view, snapshot_of(columns=1))
    assert view.spectrum.listDataItems() == [view.amplitudes, view.response]
    assert [curve.getData() for curve in (view.amplitudes, view.response)] == 2 * [(None, None)]
    assert (view.zeros, view.spectrum.accessibleDescription()) == ([], "")


def test_a_bright_panel_is_said_to_lose_light_and_every_grey_level_is_in_view(
    view: SpectrumView, snapshot_of: SnapshotOf
) -> None:
    show(view, snapshot_of(iso=100.0))
    assert "0.0 % are saturated" in view.sentence.text()
    show(view, snapshot_of(iso=6400.0, f_number=1.0))
    assert view.sentence.text().startswith("⚠")
    assert np.sum(view.bars.opts["height"]) == pytest.approx(100.0)
    assert np.max(view.bars.opts["height"]) < view.histogram.viewRange()[1][1]
    low, high = view.histogram.viewRange()[0]
    assert low <= -0.5
    assert high >= 255.5


def test_only_the_panels_pixels_are_counted(view: SpectrumView, snapshot_of: SnapshotOf) -> None:
    snapshot = snapshot_of(rows=800, distance=3.0)
    (left, top), (right, bottom) = snapshot.corners.min(axis=0), snapshot.corners.max(axis=0)
    image = snapshot.frame.camera_image
    assert min(left, top) > 20
    assert (right < image.shape[1] - 20, bottom < image.shape[0] - 20) == (True, True)
    show(view, snapshot)
    panel = image[int(top) : int(bottom) + 1, int(left) : int(right) + 1]
    counts = np.bincount(panel.ravel(), minlength=256)
    np.testing.assert_allclose(view.bars.opts["height"], 100.0 * counts / panel.size, atol=1e-9)
