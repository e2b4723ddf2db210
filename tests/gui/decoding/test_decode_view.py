"""The pane of decoding states in words what the receiver read."""

from dataclasses import replace

import numpy as np
import pytest
from gui.kinds import SnapshotOf, show_widget, with_result
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.decoding.decode_view import DecodeView
from occ_gui.simulation.jobs import reading_by_profile
from occ_model.results.decoding import DecodeResult, Region, symptom


@pytest.fixture
def view(qtbot: QtBot) -> DecodeView:
    return show_widget(qtbot, DecodeView(), 360, 400)


def texts(view: DecodeView) -> set[str]:
    return {label.text() for label in view.findChildren(QLabel) if label.isVisible()}


def test_a_right_code_is_ticked_and_wrong_bits_are_counted(
    view: DecodeView, snapshot_of: SnapshotOf
) -> None:
    view.show_reading(snapshot_of(code=718))
    assert view.verdict.text() == "✓ Code 718 read, all bits right"
    assert not view.reason.isVisible()
    assert view.strip.isVisible()
    assert view.strip.find_wrong_bits() == []
    snapshot = snapshot_of(code=718)
    received = np.array([1, 0, 1, 1, 0, 0, 1, 1, 0, 1], dtype=np.uint8)  # the last two are wrong
    result = replace(snapshot.results["threshold"], bits=received, code=717)
    view.show_reading(with_result(snapshot, result))
    assert view.verdict.text() == "✗ Code 717 read, 2 of 10 bits wrong"
    assert view.strip.find_wrong_bits() == [8, 9]
    assert not view.reason.isVisible()


def test_a_failure_is_shown_with_its_reason_and_the_bits_read_beside_it(
    view: DecodeView, snapshot_of: SnapshotOf
) -> None:
    snapshot = snapshot_of(switching_frequency=500.0, distance=5.0)
    assert snapshot.results["threshold"].failure
    view.show_reading(snapshot)
    assert view.verdict.text() == "✗ No code read"
    assert view.reason.isVisible()
    assert view.reason.text().startswith("Too few chips in view. The panel's image has room for 1 ")
    assert view.reason.text().endswith(f" {symptom(snapshot.results['threshold'].failure or '')}")
    result = DecodeResult(
        "threshold", failure="The chips break the line code.", bits=np.array([0, 0], dtype=np.uint8)
    )
    view.show_reading(with_result(snapshot_of(code=718), result))
    assert view.verdict.text() == "✗ No code read"
    assert view.strip.accessibleDescription() == "sent 1011001110, received 00, 1 wrong"


def test_a_raw_pattern_has_no_bits_to_compare(view: DecodeView, snapshot_of: SnapshotOf) -> None:
    snapshot = snapshot_of(pattern="010100010110001001000")
    view.show_reading(snapshot)
    assert view.verdict.text() == "No code is sent"
    assert not view.strip.isVisible()
    assert view.reason.text() == snapshot.results["threshold"].failure
    view.show_reading(snapshot_of())
    assert view.strip.isVisible()


def test_measured_values_have_units_and_earlier_ones_are_removed(
    view: DecodeView, snapshot_of: SnapshotOf
) -> None:
    result = DecodeResult(
        "threshold",
        failure="Stopped here.",
        region=Region(0, 200, 100, 1100),
        threshold=123.456,
        chip_length=12.5,
        chips=np.ones(77, dtype=np.uint8),
    )
    view.show_reading(with_result(snapshot_of(), result))
    assert {"1000 x 200 px", "123.5 grey levels", "12.50 columns", "77"} <= texts(view)
    units = ("px", "grey levels", "columns")
    view.show_reading(snapshot_of())
    assert all(any(text.endswith(unit) for text in texts(view)) for unit in units)
    view.show_reading(with_result(snapshot_of(), DecodeResult("threshold", failure="No.")))
    assert not any(text.endswith(units) for text in texts(view))


def test_a_slow_decoder_is_requested_when_its_tab_is_chosen(
    qtbot: QtBot, snapshot_of: SnapshotOf
) -> None:
    view = show_widget(qtbot, DecodeView(("threshold", "matched", "equalizer", "sequence")))
    snapshot = snapshot_of(code=5, exposure_time=136e-6, switching_frequency=20e3)
    view.show_reading(snapshot)
    tabs = [view.decoders.tabText(place) for place in range(view.decoders.count())]
    assert tabs == ["threshold ✗", "matched ✓", "equalizer", "sequence"]
    with qtbot.waitSignal(view.decoder_chosen) as signal:
        view.decoders.setCurrentIndex(3)
    assert signal.args == ["sequence"]
    assert "takes longer" in view.reason.text()
    read = occ.decode(snapshot.frame.image, snapshot.scene, "sequence")
    view.show_reading(with_result(snapshot, read))
    assert view.verdict.text() == "✓ Code 5 read, all bits right"
    assert view.decoders.tabText(3) == "sequence ✓"


def test_a_chosen_decoder_stays_chosen_and_shows_its_result(
    view: DecodeView, snapshot_of: SnapshotOf
) -> None:
    view.show_reading(snapshot_of())
    assert any(text.endswith(" grey levels") for text in texts(view))
    view.decoders.setCurrentIndex(1)
    assert not any(text.endswith(" grey levels") for text in texts(view))
    for code in (3, 1000):
        snapshot = snapshot_of(code=code, exposure_time=136e-6, switching_frequency=20e3)
        view.show_reading(snapshot)
        assert view.decoders.currentIndex() == 1
        assert view.verdict.text() == f"✓ Code {code} read, all bits right"
    view.decoders.setCurrentIndex(0)
    assert view.verdict.text() == "✗ No code read"
    assert view.reason.text().startswith("Beyond the null at 14.7 kHz. An exposure covers 2.72 ")
    assert view.reason.text().endswith(f" {symptom(snapshot.results['threshold'].failure or '')}")


def test_a_contradiction_between_a_picture_and_its_profile_is_stated(
    view: DecodeView, snapshot_of: SnapshotOf
) -> None:
    snapshot = snapshot_of(code=718)
    early = reading_by_profile(snapshot.request)
    view.show_reading(early)
    assert view.origin.text() == "Read from the column profile; the picture follows."
    view.show_reading(snapshot)
    assert view.origin.text() == "Read from the picture."
    failed = DecodeResult("threshold", failure="No.")
    view.show_reading(early)
    view.show_reading(with_result(snapshot, failed))
    assert view.verdict.text() == "✗ No code read"
    assert view.origin.text() == (
        "Read from the picture. The column profile alone gave: ✓ Code 718 read, all bits right."
    )
    view.decoders.setCurrentIndex(1)  # both agree on this decoder's code
    assert view.origin.text() == "Read from the picture."
    view.decoders.setCurrentIndex(0)
    view.show_reading(early)  # a profile of another scene contradicts no picture
    view.show_reading(snapshot_of(switching_frequency=500.0))
    assert view.verdict.text() == "✗ No code read"
    assert view.origin.text() == "Read from the picture."
