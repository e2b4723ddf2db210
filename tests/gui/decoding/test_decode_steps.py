"""The plots show the steps of each decoder."""

import numpy as np
import pyqtgraph as pg
import pytest
from gui.kinds import SnapshotOf, show_widget
from PySide6.QtWidgets import QLabel, QWidget
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.decoding.decode_steps import RunLengthPlot, SignalPlot
from occ_gui.simulation.snapshot import Snapshot
from occ_model.results.decoding import DecodeResult, RunHistogram


@pytest.fixture
def signal_plot(qtbot: QtBot) -> SignalPlot:
    return show_widget(qtbot, SignalPlot(), 360, 200)


@pytest.fixture
def run_length_plot(qtbot: QtBot) -> RunLengthPlot:
    return show_widget(qtbot, RunLengthPlot())


@pytest.fixture
def snapshot(snapshot_of: SnapshotOf) -> Snapshot:
    return snapshot_of()


@pytest.fixture
def matched(snapshot: Snapshot) -> DecodeResult:
    return snapshot.results["matched"]


def levels(curve: pg.PlotDataItem) -> list[float]:
    _, values = curve.getOriginalDataset()
    return [] if values is None else values.tolist()


def legend_texts(widget: QWidget) -> list[str]:
    return [label.text() for label in widget.findChildren(QLabel) if label.isVisible()]


def test_the_signal_its_threshold_and_lit_chips_under_columns_above_it_are_drawn(
    signal_plot: SignalPlot, snapshot: Snapshot
) -> None:
    result = snapshot.results["threshold"]
    signal_plot.show_result(result, snapshot.period_columns)
    assert levels(signal_plot.signal) == result.signal.tolist()
    assert levels(signal_plot.model) == []
    assert signal_plot.threshold.isVisible()
    assert signal_plot.threshold.value() == result.threshold
    bars = signal_plot.chips.opts
    assert signal_plot.chips.isVisible()
    assert len(bars["x0"]) == int((result.chips == 1).sum())
    assert result.threshold is not None
    assert bars["y0"].max() + bars["height"].max() <= result.signal.min()
    assert (bars["x0"] + bars["width"]).max() <= len(result.signal)
    first, last = signal_plot.plot.getViewBox().viewRange()[0]
    assert last - first == pytest.approx(2 * snapshot.period_columns, rel=0.1)
    centres = (bars["x0"] + bars["width"] / 2).astype(int)
    assert (result.signal[centres] > result.threshold).mean() > 0.98


def test_a_folding_decoder_shows_the_folded_signal_and_its_model_and_others_do_not(
    signal_plot: SignalPlot, snapshot: Snapshot, matched: DecodeResult
) -> None:
    signal_plot.show_result(snapshot.results["threshold"], snapshot.period_columns)
    signal_plot.show_result(matched, snapshot.period_columns)
    assert levels(signal_plot.signal) == matched.folded.tolist()
    assert levels(signal_plot.model) == matched.model.tolist()
    assert not signal_plot.chips.isVisible()
    assert not signal_plot.threshold.isVisible()
    assert "model of the code" in legend_texts(signal_plot)
    assert "threshold" not in legend_texts(signal_plot)
    signal_plot.show_result(snapshot.results["threshold"], snapshot.period_columns)
    assert levels(signal_plot.model) == []
    assert "model of the code" not in legend_texts(signal_plot)
    assert "level" in signal_plot.plot.getAxis("left").labelText


def test_a_step_that_was_not_reached_has_no_plot_and_keeps_no_chips_of_the_last_result(
    signal_plot: SignalPlot, run_length_plot: RunLengthPlot, snapshot: Snapshot
) -> None:
    nothing = DecodeResult("threshold", failure="No panel result.")
    signal_plot.show_result(nothing, 300.0)
    run_length_plot.show_result(nothing)
    assert not signal_plot.isVisible()
    assert not run_length_plot.isVisible()
    signal_plot.show_result(snapshot.results["threshold"], snapshot.period_columns)
    flat = DecodeResult("threshold", failure="No stripes.", signal=np.full(50, 7.0))
    signal_plot.show_result(flat, snapshot.period_columns)
    assert signal_plot.isVisible()
    assert not signal_plot.chips.isVisible()
    assert not signal_plot.threshold.isVisible()
    for widget in (signal_plot, run_length_plot):
        least = max(widget.minimumSizeHint().height(), widget.minimumHeight())
        assert least >= 100


def test_run_lengths_of_ones_point_up_and_of_zeros_down(run_length_plot: RunLengthPlot) -> None:
    zeros = RunHistogram(np.array([0, 0, 5, 0, 3]), split=2)
    ones = RunHistogram(np.array([0, 7, 0]), split=None)
    run_length_plot.show_result(DecodeResult("threshold", histograms=(zeros, ones)))
    bars = [
        dict(zip(b.opts["x"].tolist(), b.opts["height"].tolist(), strict=True))
        for b in run_length_plot.bars
    ]
    assert bars == [{2: -5, 4: -3}, {1: 7}]
    first, last = run_length_plot.plot.getViewBox().viewRange()[0]
    assert first <= 1
    assert last >= 4
    splits = [split.getOriginalDataset()[0] for split in run_length_plot.splits]
    assert splits[0].tolist() == [2.5, 2.5]
    assert splits[1] is None or not len(splits[1])


def test_predicted_light_is_drawn_beside_the_measured_and_the_threshold_in_equalized_light(
    signal_plot: SignalPlot, snapshot: Snapshot
) -> None:
    result = occ.decode(snapshot.frame.image, snapshot.scene, "sequence")
    signal_plot.show_result(result, snapshot.period_columns)
    assert levels(signal_plot.signal) == result.light.tolist()
    assert levels(signal_plot.model) == result.light_model.tolist()
    assert "model of the code" in legend_texts(signal_plot)
    assert "threshold" not in legend_texts(signal_plot)
    result = occ.decode(snapshot.frame.image, snapshot.scene, "equalizer")
    signal_plot.show_result(result, snapshot.period_columns)
    assert levels(signal_plot.signal) == result.equalized.tolist()
    assert signal_plot.threshold.value() == result.threshold
    assert result.equalized.min() < signal_plot.threshold.value() < result.equalized.max()
    assert "model of the code" not in legend_texts(signal_plot)
