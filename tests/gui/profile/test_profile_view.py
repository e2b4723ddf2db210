"""The column profile with that of the band model and of a photo, and the range in view."""

import math
from dataclasses import replace

import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import SnapshotOf, collect, show_widget, with_result
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QLabel, QPushButton
from pytestqt.qtbot import QtBot

from occ_gui.profile.profile_view import ProfileView
from occ_gui.simulation.controller import simulate
from occ_gui.simulation.snapshot import Snapshot, Source
from occ_gui.values.photo_results import PhotoProfile
from occ_model.camera.enhancement import enhance
from occ_model.photo.reading.load import Photo
from occ_model.results.chip_reading import ChipReading
from occ_model.results.comparison import Comparison
from occ_model.results.decoding import DecodeResult, Region
from occ_model.scene.scene import Scene, SimulationSettings


@pytest.fixture
def snapshot(snapshot_of: SnapshotOf) -> Snapshot:
    return snapshot_of()


@pytest.fixture
def view(qtbot: QtBot, snapshot: Snapshot) -> ProfileView:
    view = show_widget(qtbot, ProfileView(), 900, 300)
    view.show_reading(snapshot)
    return view


def curve_data(curve: pg.PlotDataItem) -> tuple[list[float], list[float]]:
    """Return the values of a curve; nothing for an empty curve."""
    x, y = curve.getOriginalDataset()
    return ([], []) if x is None else (x.tolist(), y.tolist())


def button(view: ProfileView, text: str) -> QPushButton:
    (found,) = [b for b in view.findChildren(QPushButton) if b.text() == text]
    return found


def legend_texts(view: ProfileView) -> list[str]:
    labels = view.legend.findChildren(QLabel)
    return [label.text() for label in labels if label.isVisible() and label.text()]


def columns_in_view(view: ProfileView) -> tuple[float, float]:
    first, last = view.plot.getViewBox().viewRange()[0]
    return first, last


@pytest.mark.parametrize("source", ["profile", "draft"])
def test_an_early_reading_is_drawn_when_the_pane_is_visible(
    view: ProfileView, snapshot_of: SnapshotOf, source: Source
) -> None:
    first, early = snapshot_of(), replace(snapshot_of(exposure_time=68e-6), source=source)
    view.hide()
    view.show_reading(first)
    view.show_reading(early)
    assert (
        curve_data(view.simulation)[1] == first.profile.tolist()
    )  # the picture follows in a moment
    view.show()
    assert curve_data(view.simulation)[1] == early.profile.tolist()
    view.show_reading(replace(first, source=source))
    assert curve_data(view.simulation)[1] == first.profile.tolist()


def test_the_band_model_is_drawn_where_it_is_defined_and_else_a_sentence_says_why_not(
    view: ProfileView, snapshot_of: SnapshotOf
) -> None:
    snapshot = snapshot_of(exposure_time=68e-6, switching_frequency=10e3, band_reading="literal")
    view.show_reading(snapshot)
    assert curve_data(view.band)[1] == snapshot.band.tolist()
    assert "band model" in legend_texts(view)
    assert view.reason.text().startswith("The band model drifts 76 columns a packet: it rounds")
    view.show_reading(snapshot_of(exposure_time=68e-6))
    assert not view.reason.isVisible()
    view.show_reading(snapshot_of(exposure_time=136e-6, switching_frequency=10e3))
    assert curve_data(view.band) == ([], [])
    assert view.reason.isVisible()
    assert "136 µs" in view.reason.text()
    assert "100 µs" in view.reason.text()
    assert "band model" not in legend_texts(view)


def test_the_band_model_is_enhanced_by_its_own_histogram(
    view: ProfileView, snapshot_of: SnapshotOf
) -> None:
    for method in ("equalization", "stretch", "none"):
        snapshot = snapshot_of(enhancement=method)
        view.show_reading(snapshot)
        view.enhanced.setChecked(True)
        assert curve_data(view.band)[1] == enhance(snapshot.band, method).tolist()
        assert view.plot.viewRange()[1][1] >= max(curve_data(view.band)[1])
        view.enhanced.setChecked(False)
        assert curve_data(view.band)[1] == snapshot.band.tolist()


def test_an_incomparable_photo_is_drawn_as_it_is_with_the_reason(
    view: ProfileView, photo: Photo
) -> None:
    view.show_photo_profile(PhotoProfile(None, photo.profile, 12.5, 2.0))
    assert view.residual.numbers.text() == "Searching for stripes…"
    view.show_photo_profile(PhotoProfile(None, photo.profile, 12.5, 2.0, "No stripes."))
    x, y = curve_data(view.photo)
    assert x[:3] == [12.5, 14.5, 16.5]
    assert y == photo.profile.tolist()
    assert view.residual.numbers.text() == "No stripes."
    assert not view.residual.plot.isVisible()
    assert "photo" in legend_texts(view)
    view.show_photo_profile(None)
    assert curve_data(view.photo) == ([], [])
    assert not view.residual.isVisible()
    assert "photo" not in legend_texts(view)


def test_a_compared_photo_is_drawn_in_simulated_levels(view: ProfileView, photo: Photo) -> None:
    measured, simulated = np.array([1.0, 5.0, 9.0]), np.array([2.0, 5.0, 6.0])
    comparison = Comparison(900, measured, simulated, 0.91234)
    view.show_photo_profile(PhotoProfile(comparison, photo.profile))
    assert curve_data(view.photo) == ([900, 901, 902], measured.tolist())
    assert curve_data(view.residual.curve) == ([900, 901, 902], [-1.0, 0.0, 3.0])
    assert view.residual.plot.isVisible()
    assert "photo, fitted levels" in legend_texts(view)
    assert "photo" not in legend_texts(view)
    far = Comparison(900, np.array([1.0, 300.0, 9.0]), simulated, 0.9)
    view.show_photo_profile(PhotoProfile(far, photo.profile))
    assert 255.0 <= view.plot.viewRange()[1][1] < 280.0  # there is no brighter grey level
    view.show_photo_profile(PhotoProfile(comparison, photo.profile))
    assert "0.9123" in view.residual.numbers.toolTip()
    assert f"{math.sqrt(10 / 3):.2f} grey levels" in view.residual.numbers.toolTip()
    low, high = view.residual.plot.getViewBox().viewRange()[1]
    assert low < -3.0
    assert high > 3.0
    before = view.plot.viewRange()[0]
    view.show_photo_profile(PhotoProfile(Comparison(0, np.ones(5), np.ones(5), 0.0), photo.profile))
    view.resize(view.width() + 50, view.height() + 50)
    QApplication.processEvents()
    for plot in (view.plot, view.residual.plot):
        assert plot.viewRange()[0] == pytest.approx(before)


def test_neither_one_edge_nor_the_scene_before_sets_the_axis_of_the_residual(
    view: ProfileView, photo: Photo
) -> None:
    smooth = 100.0 + 4.0 * np.sin(np.arange(300.0))
    edge = smooth.copy()
    edge[:6] += 90.0
    for profile, is_outside in ((smooth, False), (edge, True)):
        comparison = Comparison(0, profile, np.full(300, 100.0), 0.9)
        view.show_photo_profile(PhotoProfile(comparison, photo.profile))
        assert view.residual.plot.getViewBox().viewRange()[1] == pytest.approx([-7.0, 7.0])
        text = view.residual.numbers.toolTip()
        assert ("outside the axis" in text) == is_outside
    assert f"largest residual {comparison.largest_residual:.0f}, outside" in text
    ends = []
    for height, is_outdated in ((190.0, True), (4.0, False), (40.0, False), (4.0, False)):
        comparison = Comparison(0, np.full(300, 100.0 + height), np.full(300, 100.0), 0.9)
        shown = PhotoProfile(comparison, photo.profile, photo=photo, is_outdated=is_outdated)
        view.show_photo_profile(shown)
        ends.append(view.residual.plot.getViewBox().viewRange()[1][1])
    assert ends == pytest.approx([1.4 * 200.0, 1.4 * 5.0, 1.4 * 50.0, 1.4 * 50.0])


def test_the_residual_follows_the_profiles_columns_when_moved(
    view: ProfileView, photo: Photo
) -> None:
    comparison = Comparison(0, np.ones(5), np.ones(5), 0.0)
    view.show_photo_profile(PhotoProfile(comparison, photo.profile))
    boxes = [plot.getViewBox() for plot in (view.plot, view.residual.plot)]
    for one, other in (boxes, boxes[::-1]):
        for columns in ((10, 22), (50, 90)):
            one.setXRange(*columns, padding=0)
            one.sigRangeChangedManually.emit([True, True])  # as by the mouse
            assert other.viewRange()[0] == pytest.approx(columns)
    QApplication.processEvents()
    lefts = [plot.getAxis("left").width() for plot in (view.plot, view.residual.plot)]
    assert lefts[0] == lefts[1]


def test_after_enhancement_shows_picture_levels_and_threshold(
    view: ProfileView, qtbot: QtBot, snapshot: Snapshot
) -> None:
    columns = list(range(len(snapshot.frame.profile)))
    for enhanced, levels in ((False, snapshot.frame.profile), (True, snapshot.frame.signal)) * 2:
        assert curve_data(view.simulation) == (columns, levels.tolist())
        assert view.threshold.isVisible() == enhanced
        assert ("threshold" in legend_texts(view)) == enhanced
        if enhanced:
            assert view.threshold.value() == snapshot.results["threshold"].threshold
        qtbot.keyClick(view.enhanced, Qt.Key.Key_Space)
    view.enhanced.setChecked(True)
    view.show_reading(with_result(snapshot, DecodeResult("threshold", failure="None.")))
    assert not view.threshold.isVisible()
    assert "threshold" not in legend_texts(view)


def test_the_profile_before_is_drawn_named_and_in_view(
    view: ProfileView, qtbot: QtBot, snapshot_of: SnapshotOf
) -> None:
    assert "before" not in legend_texts(view)
    brighter = snapshot_of(iso=1600.0)
    view.show_before(brighter)
    assert "before" in legend_texts(view)
    assert curve_data(view.before)[1] == brighter.frame.profile.tolist()
    assert view.plot.viewRange()[1][1] >= brighter.frame.profile.max()
    qtbot.keyClick(view.enhanced, Qt.Key.Key_Space)
    assert curve_data(view.before)[1] == brighter.frame.signal.tolist()


@pytest.mark.parametrize("tolerance", [0.0, math.inf])
def test_what_is_drawn_enhanced_is_what_the_decoder_reads(
    view: ProfileView, small_scene: Scene, tolerance: float
) -> None:
    view.enhanced.setChecked(True)
    blurred = small_scene.replace(point_spread=2.0, vignetting_exponent=4.0)
    snapshot = simulate(blurred, SimulationSettings(tolerance=tolerance))
    assert (snapshot.frame.plan.kinds <= {"column"}) == math.isinf(tolerance)
    view.show_reading(snapshot)
    region, read = snapshot.results["threshold"].region, snapshot.results["threshold"].signal
    assert read is not None
    assert float(np.ptp(read)) > 100.0
    columns = slice(region.first_column, region.last_column)
    shown = np.array(curve_data(view.simulation)[1])[columns]
    # The rectangle that is read may have some rows more or less than the panel.
    assert np.abs(shown - read)[1:-1].max() <= 1.0


def test_whatever_is_drawn_lies_within_the_levels_in_view_up_to_the_next_step_above(
    view: ProfileView, snapshot_of: SnapshotOf, photo: Photo
) -> None:
    view.show_photo_profile(PhotoProfile(None, photo.profile))
    for changes in ({}, {"iso": 6400.0}, {"luminance": 0.0}):
        view.show_reading(snapshot_of(**changes))
        low, high = view.plot.getViewBox().viewRange()[1]
        values = [
            value
            for curve in (view.simulation, view.band, view.photo)
            for value in curve_data(curve)[1]
        ]
        assert low <= min(values)
        step = 20.0 * math.ceil(max(values) / 20.0)
        assert max(values) <= step <= high <= 1.1 * step


def test_two_packets_are_in_view_until_the_panel_is_chosen_or_the_plot_is_moved(
    view: ProfileView, qtbot: QtBot, snapshot: Snapshot, snapshot_of: SnapshotOf
) -> None:
    panel, followed = snapshot.frame.corners[:, 0], columns_in_view(view)
    packets, whole = button(view, "2 packets"), button(view, "Panel")
    assert followed[1] - followed[0] == pytest.approx(2 * snapshot.period_columns, rel=0.05)
    assert followed[0] == pytest.approx(panel.min(), abs=20)
    qtbot.mouseClick(whole, Qt.MouseButton.LeftButton)
    assert columns_in_view(view) == pytest.approx((panel.min(), panel.max()), abs=30)
    assert not packets.isChecked()
    box = view.plot.getViewBox()
    box.setXRange(10, 20, padding=0)
    box.sigRangeChangedManually.emit([True, True])
    view.show_reading(snapshot_of(distance=1.3))
    assert columns_in_view(view) == pytest.approx((10, 20))
    assert (packets.isChecked(), whole.isChecked()) == (False, False)
    view.show_reading(snapshot)
    qtbot.mouseClick(packets, Qt.MouseButton.LeftButton)
    assert columns_in_view(view) == pytest.approx(followed)


def test_without_a_panel_or_with_one_at_the_edge_there_is_a_range_in_view(
    view: ProfileView, snapshot_of: SnapshotOf
) -> None:
    for changes in ({"columns": 1}, {"distance": 900.0}, {"offset_x": 50.0}):
        snapshot = snapshot_of(**changes)
        view.show_reading(snapshot)
        first, last = columns_in_view(view)
        assert last - first >= 1.0
        assert curve_data(view.simulation)[0]
    last_column = len(snapshot.frame.profile) - 1
    button(view, "Panel").click()
    assert columns_in_view(view) == pytest.approx((0, last_column), abs=0.02 * last_column)
    for pattern, text in (("10", "2 periods"), ("1101000", "2 cycles"), ("", "2 packets")):
        view.show_reading(snapshot_of(pattern=pattern))
        assert button(view, text).isVisibleTo(view)


def test_the_columns_in_view_are_some_of_the_picture(view: ProfileView, snapshot: Snapshot) -> None:
    columns = len(snapshot.frame.profile)
    view.plot.getViewBox().setLimits(xMin=None, xMax=None)
    for limits in ((-40.0, 12.4), (20.5, 31.7), (590.0, 2000.0), (5000.0, 5100.0)):
        view.plot.setXRange(*limits, padding=0.0)
        first, end = view.columns_in_view()
        assert 0 <= first < end <= columns
        low, high = columns_in_view(view)
        whole = [column for column in range(columns) if low <= column <= high]
        assert not whole or (whole[0], whole[-1] + 1) == (first, end)


def test_the_columns_that_are_not_read_are_shaded_where_there_is_a_region(
    view: ProfileView, snapshot: Snapshot
) -> None:
    before, after = view.shades
    read = snapshot.results["threshold"].region
    assert (before.isVisible(), after.isVisible()) == (True, True)
    assert before.getRegion()[0] <= 0 < before.getRegion()[1] == read.first_column
    assert after.getRegion()[0] == read.last_column
    assert after.getRegion()[1] >= len(snapshot.frame.profile)
    view.show_reading(with_result(snapshot, DecodeResult("threshold", failure="None.")))
    assert (before.isVisible(), after.isVisible()) == (False, False)


CHIPS = np.array([1, 0, 1, 1, 0], np.uint8)


def reading(confidence: float = 0.99) -> ChipReading:
    return ChipReading(CHIPS, 10.0, confidence, 5.0, Region(0, 9, 0, 60))


@pytest.fixture
def view_with_chips(view: ProfileView) -> ProfileView:
    view.chips.show_chips(reading())
    view.plot.setXRange(0.0, 100.0, padding=0.0)
    QApplication.processEvents()
    return view


def edges(view: ProfileView) -> list[float]:
    """Return the columns at which the cells begin, and the end of the last cell."""
    (low, high), cells = view.plot.viewRange()[0], view.chips.cells
    box = view.plot.getViewBox().sceneBoundingRect()
    found = cells.rectangles()
    ends = [one.left() for _, one in found] + [found[-1][1].right()]
    left = cells.mapFrom(view, view.plot.mapTo(view, view.plot.rect().topLeft())).x()
    return [(end - left - box.left()) / box.width() * (high - low) + low for end in ends]


def test_each_chip_in_view_lies_under_its_columns_also_where_the_photo_is_moved(
    view_with_chips: ProfileView,
) -> None:
    cells = view_with_chips.chips.cells
    assert [chip for chip, _ in cells.rectangles()] == CHIPS.tolist()
    assert edges(view_with_chips) == pytest.approx([5, 15, 25, 35, 45, 55], abs=0.5)
    view_with_chips.plot.setXRange(26.0, 44.0, padding=0.0)
    assert [chip for chip, _ in cells.rectangles()] == [1, 1]
    view_with_chips.show_photo_profile(PhotoProfile(None, np.full(60, 50.0), 20.0, 0.5))
    view_with_chips.plot.setXRange(0.0, 100.0, padding=0.0)
    assert edges(view_with_chips) == pytest.approx([22.5, 27.5, 32.5, 37.5, 42.5, 47.5], abs=0.5)
    axis = view_with_chips.plot.getAxis("left").width()
    assert view_with_chips.chips.copy.width() == pytest.approx(axis, abs=1) == cells.x()


def test_chips_are_copied_as_text_and_described_in_words(
    view_with_chips: ProfileView, qtbot: QtBot
) -> None:
    said = collect(view_with_chips.chips.copied)
    qtbot.mouseClick(view_with_chips.chips.copy, Qt.MouseButton.LeftButton)
    assert QGuiApplication.clipboard().text() == "10110"
    assert said == ["Copied: 10110"]
    cells = view_with_chips.chips.cells
    assert cells.toolTip() == (
        "5 chips read from the photo, 10.00 columns each; the probability that all of "
        "them are right is 99 %"
    )
    assert cells.accessibleDescription().endswith(": 10110")
    assert view_with_chips.chips.isVisible()
    view_with_chips.chips.show_chips(None)
    assert not view_with_chips.chips.isVisible()


def test_uncertain_chips_are_drawn_faintly(view_with_chips: ProfileView) -> None:
    certain = view_with_chips.chips.cells.grab().toImage()
    view_with_chips.chips.show_chips(reading(0.6))
    uncertain = view_with_chips.chips.cells.grab().toImage()
    place = view_with_chips.chips.cells.rectangles()[0][1].center().toPoint()
    place.setY(3)
    assert certain.pixelColor(place).lightness() < uncertain.pixelColor(place).lightness()
