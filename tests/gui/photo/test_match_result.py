"""Result of a match: its verdict, values with their uncertainties, and buttons that use them."""

from dataclasses import replace

from gui.photo.photo_bench import LiveView, names_of_steps
from matches import match_of_lamp
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from occ_gui.widgets.state_look import State
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Alternative, Match
from occ_model.scene.units import SECOND


def test_results_stand_with_uncertainty_in_the_screens_units(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(replace(photo, exposure_time=1 / 16000))
    view.confirm({"switching_frequency": 2e3})
    view.show_matched(match)
    texts = {name: label.text() for name, label in view.result.figures.labels.items()}
    assert texts["readout_time"] == "14.57770 ± 0.00027 µs"
    assert texts["exposure_time"] == "62.50 ± 0.21 µs"
    assert texts["noted"] == "62.5 µs"
    assert texts["switching_frequency"] == "2 kHz (given)"
    assert texts["chip"] == f"{1 / (2e3 * 14.5777e-6):.3f} columns, 4 chips a period"
    assert texts["correlation"] == "0.9912 (rims included)"
    assert texts["residual"] == "2.00 grey levels (rims included)"
    assert texts["region"].startswith("columns 0 to 2, rows ")
    assert texts["saturated"].startswith("12.5 %")
    assert texts["periods"] == f"{3 * 2e3 * 14.5777e-6 / 4:.3g}"
    assert texts["exposed"] == "0.125"
    assert (texts["duty"], texts["lamp_frequency"]) == ("", "")
    assert view.result.figures.labels["pattern"].toolTip() == "1010 (read from the photo)"
    assert "one standard deviation" in view.result.figures.labels["exposure_time"].toolTip()
    spreads = {**match.uncertainties, "exposure_time": 15e-6}
    view.show_matched(replace(match, exposure_time=6e-6, uncertainties=spreads))
    assert view.result.figures.labels["exposure_time"].text() == "below 36 µs (6 ± 15 µs)"
    spreads["exposure_time"] = 29e-6
    view.show_matched(replace(match, exposure_time=55e-6, uncertainties=spreads))
    assert view.result.figures.labels["exposure_time"].text() == "below 110 µs (55 ± 29 µs)"


def test_a_lamp_that_blinks_with_any_duty_is_known_by_its_cycles(
    view: LiveView,
) -> None:
    view.show_matched(match_of_lamp(0.6))
    texts = {name: label.text() for name, label in view.result.figures.labels.items()}
    assert (texts["lamp_frequency"], texts["duty"]) == ("1 kHz (assumed)", "60 % (given)")
    assert texts["period"] == f"{1 / (1e3 * 14.5777e-6):.4g} columns"
    assert texts["exposed_periods"] == "0.0625"
    assert {texts[name] for name in ("switching_frequency", "pattern", "chip", "exposed")} == {""}
    assert view.result.condition.text() == "These values hold only if it is a lamp of 1 kHz."


def test_one_photo_gives_the_frames_readout_and_lines_for_other_programs(
    view: LiveView, match: Match
) -> None:
    match = replace(match, scene=match.scene.replace(columns=1000))
    view.show_matched(match)
    paste = view.result.paste
    view.result.more.setChecked(True)
    assert view.result.condition.text() == "These values hold only if f = 2 kHz."
    assert view.result.figures.labels["frame"].text() == "14.57770 ± 0.00027 ms"
    assert (paste.lines, paste.reason.isVisible()) == ({}, True)
    view.confirm({"switching_frequency": 2e3})
    assert not view.result.condition.isVisible()
    texts = {program: field.text() for program, field in paste.lines.items()}
    assert texts["OpenDroneMap"].endswith("--rolling-shutter-readout 14.57770")
    assert "LeftToRight" in texts["Gyroflow"]
    assert paste.note.isVisible()
    assert "direction in Gyroflow's line is assumed" in paste.note.text()
    view.show_matched(replace(match, reasons=("Few periods.",)))
    assert paste.lines == {}
    assert not paste.note.isVisible()


def test_a_match_says_which_shutter_speeds_show_no_bars(view: LiveView, match: Match) -> None:
    scene = match.scene.replace(pattern="10", switching_frequency=3840.0)
    view.confirm({"switching_frequency": 2e3})
    found = replace(match, scene=scene)
    view.show_matched(found)
    rest = (
        "no bars at whole multiples of 520.8 µs. "
        "Set 1/640 s or 1/320 s if the camera keeps the marked times exactly, "
        "else 1/240 s or 1/120 s."
    )
    # Such a short exposure is all lit or all dark: twice the mean of a lamp lit half the time.
    exposure = SECOND.format(match.exposure_time, 3)
    depth = f"bars of 200 % of the mean light from dark to bright at {exposure}, "
    lamp = "This lamp repeats at 1.92 kHz and is lit for 50 % of the time: "
    assert view.result.cure.text() == lamp + depth + rest
    # Half a period is left of 1.5: (1/2) / (1.5 / 2), and less with 0.05 more or fewer.
    longer = scene.replace(exposure_time=1.5 / 1920.0)
    error = {"exposure_time": 0.025 / 1920.0}
    view.show_matched(replace(found, scene=longer, uncertainties=error))
    assert "bars of 58.1 to 66.7 % of the mean light from dark to bright" in view.result.cure.text()
    view.show_matched(replace(found, exposure_reasons=("Two exposures fit.",)))
    assert view.result.cure.text() == lamp + rest
    view.confirm({})
    assert view.result.cure.text() == lamp + rest
    assert view.result.condition.text() == "These values hold only if f = 2 kHz."


def test_what_was_not_estimated_is_not_shown(view: LiveView, match: Match) -> None:
    estimated = replace(match, uncertainties={"gamma": 0.05}, other_exposures=(1e-3, 2e-3))
    for shown, there in ((match, False), (estimated, True)):
        view.show_matched(shown)
        view.result.more.setChecked(True)
        titles = [label.text() for label in view.result.findChildren(QLabel) if label.isVisible()]
        assert ("Gamma" in titles) == there
        assert ("1 ms or 2 ms" in titles) == there


def test_reasons_and_values_are_behind_a_button_that_stays_pressed(
    view: LiveView, match: Match
) -> None:
    doubtful = replace(match, reasons=("Few periods.",))
    view.show_matched(doubtful)
    result = view.result
    folded = (result.reasons, result.figures, result.condition)
    assert not any(part.isVisible() for part in folded)
    for is_open in (True, False, True):
        result.more.setChecked(is_open)
        assert all(part.isVisible() == is_open for part in folded)
    view.show_matched(replace(doubtful, gamma=2.0))
    assert all(part.isVisible() for part in folded)


def test_without_a_match_there_is_nothing_to_apply(
    view: LiveView, match: Match, qtbot: QtBot
) -> None:
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
    return [view.result.figures.labels[name].text() for name in names]


def test_a_result_that_depends_on_an_assumed_value_says_so_until_it_is_confirmed(
    view: LiveView, photo: Photo, match: Match, qtbot: QtBot
) -> None:
    view.change(scene=match.scene.replace(switching_frequency=2e3))
    view.show_matched(match)
    view.result.more.setChecked(True)
    assumed = ["14.57770 ± 0.00027 µs", "2 kHz (assumed)", "62.50 ± 0.21 µs"]
    assert estimates(view) == assumed
    assert view.result.condition.isVisible()
    qtbot.mouseClick(view.form.certain, Qt.MouseButton.LeftButton)
    assert estimates(view) == ["14.57770 ± 0.00027 µs", "2 kHz (given)", "62.50 ± 0.21 µs"]
    assert not view.result.condition.isVisible()
    view.open(replace(photo, channel="red"))  # the same photo, read in another way
    view.show_matched(match)
    assert estimates(view)[1] == "2 kHz (given)"
    view.open(replace(photo, path=photo.path.with_name("another.png")))
    view.show_matched(match)
    assert estimates(view) == assumed
    spreads = {"switching_frequency": 1.0, "exposure_time": 2e-7, "gamma": 0.05}
    view.show_matched(replace(match, uncertainties=spreads))
    readout, frequency, exposure = estimates(view)
    assert readout == "14.5777 µs (assumed)"
    assert frequency.startswith("2.0000 ± 0.0010 kHz")
    assert exposure.endswith("µs")
    assert view.result.condition.text() == "These values hold only if t_r = 14.5777 µs."


ONLY = "Only the exposure time, and with it the start time, is doubtful."
REASONS = ("Only 1.2 periods of 21 chips are in view.", "The correlation is 0.85.")
PLAIN = Alternative("a smooth curve", "", 0.91, 12.34)
READ = Alternative("chips that were read", "1100", 0.95, -3.21, 7.2e-6, 2e3, 8e-5)


def test_a_doubtful_exposure_is_stated_beside_sure_values(view: LiveView, match: Match) -> None:
    view.confirm({"switching_frequency": 2e3})
    view.show_matched(replace(match, exposure_reasons=REASONS))
    result = view.result
    assert result.reasons.text().splitlines() == [
        f"• {ONLY} {REASONS[0]}", f"• {REASONS[1]}",
    ]  # fmt: skip
    assert result.figures.labels["exposure_time"].text() == "62.50 ± 0.21 µs (doubtful)"
    assert result.figures.labels["start_time"].text().endswith(" (doubtful)")
    assert "doubtful" not in result.figures.labels["readout_time"].text()
    view.show_matched(replace(match, reasons=REASONS[:1], exposure_reasons=REASONS[1:]))
    assert result.reasons.text() == "\n".join(f"• {reason}" for reason in REASONS)


def test_other_explanations_are_stated_with_their_assumptions(view: LiveView, match: Match) -> None:
    view.show_matched(match)
    assert not view.result.figures.labels["alternative"].isVisible()
    view.show_matched(replace(match, alternatives=(READ, PLAIN)))
    assert view.result.figures.labels["alternative"].text().splitlines() == [
        "• chips that were read: correlation 0.950, log-likelihood lower by 3.2; "
        "readout time 7.2 µs, exposed for 80 µs",
        "• a smooth curve: correlation 0.910, log-likelihood higher by 12.3",
    ]


def test_an_outdated_match_is_covered_at_once_not_used_and_no_step_on_the_way(
    view: LiveView, match: Match
) -> None:
    view.show_matched(match)
    result, steps, bar = view.result, view.steps, view.verdict
    result.more.setChecked(True)
    assert result.more.geometry().bottom() < result.details.geometry().top()
    for why in ("of another part of the photo: match again", ""):
        is_present = not why
        view.change(part=None if is_present else match.region)
        assert result.mark.isVisible() != is_present
        assert result.reasons.isEnabled() == is_present
        for button in (result.apply, result.save, result.without_bars, steps.buttons["apply"]):
            assert button.isEnabled() == is_present
        assert names_of_steps(steps)[2:] == (
            ["Match: done", "Apply: done"] if is_present else ["Match: next step", "Apply"]
        )
        assert bar.state is (State.GOOD if is_present else State.WAITING)
        assert (why or "reads a line in") in bar.accessibleDescription()
        assert result.mark.text == why or is_present
