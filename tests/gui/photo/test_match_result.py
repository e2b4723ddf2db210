"""Result of a match: values with their uncertainties, and buttons that use them."""

from dataclasses import replace

import pytest
from gui.photo.photo_bench import LiveView
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_model.photo.estimate_text import estimate_text
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.units import SECOND
from occ_model.study.bands.cure import cure_of

READOUT = PARAMETERS["readout_time"]


def test_results_stand_with_uncertainty_in_the_screens_units(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.result.show_certain({"switching_frequency": 2e3})
    view.show_matched(match)
    texts = {name: label.text() for name, label in view.result.values.items()}
    assert texts["readout_time"] == "14.57770 ± 0.00027 µs"
    assert texts["exposure_time"] == "62.50 ± 0.21 µs"
    assert texts["switching_frequency"] == "2 kHz (given)"
    assert texts["chip"] == f"{1 / (2e3 * 14.5777e-6):.3f} columns, 4 chips a period"
    assert texts["correlation"] == "0.9912 (rims included)"
    assert texts["residual"] == "2.00 grey levels (rims included)"
    assert texts["region"].startswith("columns 0 to 2, rows ")
    assert texts["saturated"].startswith("12.5 %")
    assert view.result.values["pattern"].toolTip() == "1001 (read from the photo)"


def test_one_photo_gives_the_frames_readout_and_lines_for_other_programs(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    match = replace(match, scene=match.scene.replace(columns=1000))
    view.show_matched(match)
    paste = view.result.paste
    assert view.result.condition.text() == "What follows holds if f = 2 kHz."
    assert view.result.values["frame"].text() == "14.57770 ± 0.00027 ms"
    assert (paste.lines, paste.why_none.isVisible()) == ({}, True)
    view.result.show_certain({"switching_frequency": 2e3})
    assert not view.result.condition.isVisible()
    texts = {program: field.text() for program, field in paste.lines.items()}
    assert texts["OpenDroneMap"].endswith("--rolling-shutter-readout 14.57770")
    assert "LeftToRight" in texts["Gyroflow"]
    assert paste.note.isVisible()
    assert "direction in Gyroflow's line is assumed" in paste.note.text()
    view.show_matched(replace(match, reasons=("Few periods.",)))
    assert paste.lines == {}
    assert not paste.note.isVisible()


def test_an_exposure_that_is_hardly_known_has_an_upper_limit(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.result.show_certain({"switching_frequency": 2e3})
    spreads = {**match.uncertainties, "exposure_time": 15e-6}
    view.show_matched(replace(match, exposure_time=6e-6, uncertainties=spreads))
    assert view.result.values["exposure_time"].text() == "below 36 µs (6 ± 15 µs)"
    assert "one standard deviation" in view.result.values["exposure_time"].toolTip()


def test_a_match_says_which_shutter_speeds_show_no_bars(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    scene = match.scene.replace(pattern="10", switching_frequency=3840.0)
    view.result.show_certain({"switching_frequency": 2e3})
    found = replace(match, scene=scene)
    view.show_matched(found, cure_of(scene))
    rest = (
        "no bars at whole multiples of 520.8 µs. "
        "Set 1/640 s or 1/320 s if the camera keeps what is written, else 1/240 s or 1/120 s."
    )
    # So short an exposure is all lit or all dark: twice the mean of a lamp that is lit by half.
    depth = f"bars of 200 % of its light at {SECOND.format(match.exposure_time, 3)}, "
    lamp = "This lamp repeats at 1.92 kHz and is lit for 50 % of the time: "
    assert view.result.cure.text() == lamp + depth + rest
    # Half a period is left of 1.5: (1/2) / (1.5 / 2), and less with 0.05 more or fewer.
    longer = scene.replace(exposure_time=1.5 / 1920.0)
    view.show_matched(found, cure_of(longer, exposure_error=0.025 / 1920.0))
    assert "bars of 58.1 to 66.7 % of its light" in view.result.cure.text()
    view.show_matched(replace(found, exposure_reasons=("Two exposures fit.",)), cure_of(scene))
    assert view.result.cure.text() == lamp + rest
    view.result.show_certain({})
    assert view.result.cure.text() == lamp + rest
    assert view.result.condition.text() == "What follows holds if f = 2 kHz."


def test_a_blinking_led_is_described_by_its_cycles_too(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.show_matched(replace(match, pattern="10"))
    text = view.result.values["switching_frequency"].text()
    assert text == "2 kHz: blinks at 1 kHz (assumed)"


def test_what_was_not_estimated_is_not_shown(view: LiveView, photo: Photo, match: Match) -> None:
    view.open(photo)
    estimated = replace(match, uncertainties={"gamma": 0.05}, other_exposures=(1e-3, 2e-3))
    for shown, there in ((match, False), (estimated, True)):
        view.show_matched(shown)
        titles = [label.text() for label in view.result.findChildren(QLabel) if label.isVisible()]
        assert ("Gamma" in titles) == there
        assert ("1 ms or 2 ms" in titles) == there


@pytest.mark.parametrize(
    ("value", "spread", "text"),
    [
        (14.5777e-6, 2.7e-10, "14.57770 ± 0.00027 µs"),
        (14.5777e-6, 3e-6, "14.6 ± 3.0 µs"),
        (14.5777e-6, 40e-6, "15 ± 40 µs"),
        (0.0, 1e-7, "0 ± 100 ns"),
        (8e-6, None, "8 µs"),
        (8e-6, float("nan"), "8 µs"),
        (8e-6, float("inf"), "8 µs"),
        (8e-6, 0.0, "8 µs"),
        (8e-6, 1e-30, "8 µs"),
    ],
)
def test_a_value_has_the_digits_that_its_uncertainty_allows(
    value: float, spread: float | None, text: str
) -> None:
    assert isinstance(READOUT, Quantity)
    assert text in estimate_text(READOUT, value, spread)


def test_without_a_match_there_is_nothing_to_apply(
    view: LiveView, photo: Photo, match: Match, qtbot: QtBot
) -> None:
    view.open(photo)
    view.show_matched(match)
    for button, signal in (
        (view.result.apply, view.result.apply_asked),
        (view.result.save, view.result.save_asked),
        (view.result.without_bars, view.result.cure_asked),
    ):
        with qtbot.waitSignal(signal):
            qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    view.show_matched(None)
    assert not view.result.isVisible()


def estimates(view: LiveView) -> list[str]:
    names = ("readout_time", "switching_frequency", "exposure_time")
    return [view.result.values[name].text() for name in names]


def test_what_rests_on_an_assumed_value_says_so_until_it_is_confirmed(
    view: LiveView, photo: Photo, match: Match, qtbot: QtBot
) -> None:
    view.open(photo)
    view.show_scene(match.scene.replace(switching_frequency=2e3))
    view.show_matched(match)
    assumed = ["14.57770 ± 0.00027 µs", "2 kHz (assumed)", "62.50 ± 0.21 µs"]
    assert estimates(view) == assumed
    assert view.result.condition.isVisible()
    qtbot.mouseClick(view.form.certain, Qt.MouseButton.LeftButton)
    assert estimates(view) == ["14.57770 ± 0.00027 µs", "2 kHz (given)", "62.50 ± 0.21 µs"]
    assert not view.result.condition.isVisible()
    view.open(replace(photo, channel="red"))  # the same photo, read in another way
    assert estimates(view)[1] == "2 kHz (given)"
    view.open(replace(photo, path=photo.path.with_name("another.png")))
    assert estimates(view) == assumed


def test_a_frequency_that_rests_on_a_readout_time_says_so(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    spreads = {"switching_frequency": 1.0, "exposure_time": 2e-7, "gamma": 0.05}
    view.show_matched(replace(match, uncertainties=spreads))
    readout, frequency, exposure = estimates(view)
    assert readout == "14.5777 µs (assumed)"
    assert frequency.startswith("2.0000 ± 0.0010 kHz")
    assert exposure.endswith("µs")
    assert view.result.condition.text() == "What follows holds if t_r = 14.5777 µs."
