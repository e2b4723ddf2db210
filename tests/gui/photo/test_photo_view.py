"""Pane of the photo: its steps, its facts, a failed match, and its placement."""

from dataclasses import replace
from pathlib import Path

import pytest
from gui.combo_box import choose
from gui.kinds import add_widget, collect
from gui.photo.photo_bench import LiveView, names_of_steps
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton, QWidget
from pytestqt.qtbot import QtBot

from occ_gui.photo.photo_verdict import STEPS, PhotoSteps
from occ_gui.values.choices import Placement
from occ_model.photo.reading.choices import CHANNELS, SCAN_AXES
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match


def test_without_a_photo_all_a_user_can_press_opens_one_or_a_sample(
    view: LiveView, qtbot: QtBot
) -> None:
    view.open(None)
    assert not view.form.isVisible()
    visible = [b for b in view.findChildren(QPushButton) if b.isVisible() and b.isEnabled()]
    assert {button.text() for button in visible} == {"1 Open", "&Open photos…"}
    for button in visible:
        with qtbot.waitSignal(view.open_asked):
            qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    paths = [Path("square-wave.png"), Path("packet.png")]
    view.show_samples(dict(zip(("Square wave", "Packet"), paths, strict=True)))
    buttons = [one for one in view.findChildren(QPushButton) if one.text().startswith("Sample")]
    texts = [one.text() for one in buttons]
    assert texts == ["Sample: Square wave (simulated)", "Sample: Packet (simulated)"]
    for path, button in zip(paths, buttons, strict=True):
        with qtbot.waitSignal(view.sample_chosen) as opened:
            button.click()
        assert opened.args == [path]


def test_facts_about_a_photo_are_shown_with_their_units(
    view: LiveView, photo: Photo, qtbot: QtBot
) -> None:
    facts = view.facts
    assert facts.size_line.toolTip() == "100 x 60 px, grey"
    assert not facts.use_settings.isEnabled()
    view.open(replace(photo, is_linear=True))
    assert facts.size_line.toolTip() == "100 x 60 px, grey, linear: gamma 1"
    noted = replace(photo, exposure_time=1 / 8000, iso=12800.0, f_number=1.8)
    view.open(replace(noted, camera="Maker Model 5", turned=True))
    assert facts.name.toolTip().endswith("stripes.png")
    assert facts.size_line.toolTip() == "Maker Model 5, 60 x 100 px, grey, turned"
    assert facts.notes.toolTip() == "125 µs, ISO 12800, f/1.8"
    with qtbot.waitSignal(facts.settings_asked):
        qtbot.mouseClick(facts.use_settings, Qt.MouseButton.LeftButton)


def test_every_channel_and_scan_axis_of_the_model_can_be_chosen(
    view: LiveView, qtbot: QtBot
) -> None:
    received = collect(view.facts.channel.chosen)
    view.facts.scan_axis.chosen.connect(received.append)
    choices = ((view.facts.channel, CHANNELS), (view.facts.scan_axis, SCAN_AXES))
    for control, keys in choices:
        assert [control.itemData(place) for place in range(control.count())] == list(keys)
        choose(qtbot, control, keys[1])
    assert received == [CHANNELS[1], SCAN_AXES[1]]
    view.facts.show_load_options("red", "lines")
    assert (view.facts.channel.key(), view.facts.scan_axis.key()) == ("red", "lines")
    assert len(received) == 2


def test_the_placement_is_shown_and_a_changed_field_alone_moves_the_photo(
    view: LiveView, qtbot: QtBot
) -> None:
    form, received = view.placement, collect(view.placement.placed)
    form.show_placement(Placement(862.237123, 3.5, 1.25), by_hand=True)
    assert (form.column.value(), form.row.value(), form.scale.value()) == (862.24, 3.5, 1.25)
    assert received == []
    with qtbot.waitSignal(form.moving_chosen) as moving:
        form.by_mouse.click()
    assert moving.args == [True]
    with qtbot.waitSignal(form.reset_asked):
        form.reset.click()
    form.show_placement(Placement(862.237123, 3.5, 1.0), by_hand=False)
    assert not form.reset.isEnabled()
    form.row.selectAll()
    qtbot.keyClicks(form.row, "10")
    qtbot.keyClick(form.row, Qt.Key.Key_Return)
    assert received == [Placement(862.237123, 10.0, 1.0)]


def test_the_placement_reads_a_decimal_comma_and_refuses_the_rest(
    view: LiveView, photo: Photo, qtbot: QtBot
) -> None:
    placed = collect(view.placement.placed)
    view.open(photo)
    form = view.placement

    def enter(field: QWidget, text: str) -> None:
        field.setFocus()
        qtbot.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        qtbot.keyClicks(field, text)
        qtbot.keyClick(field, Qt.Key.Key_Return)

    enter(form.column, "12,5")
    enter(form.row, "-3.25 px")
    enter(form.scale, "1,5")
    assert placed[-1] == Placement(12.5, -3.25, 1.5)
    count = len(placed)
    for field, text in ((form.column, "1,000"), (form.row, "left"), (form.scale, "0")):
        shown = field.text()
        enter(field, text)
        assert field.notice.isVisible()
        assert "cannot be" in field.notice.text()
        assert field.text() == shown
    assert len(placed) == count
    enter(form.column, "13")
    assert not form.column.notice.isVisible()
    assert placed[-1].column == 13.0


@pytest.fixture
def steps(qtbot: QtBot) -> PhotoSteps:
    return add_widget(qtbot, PhotoSteps())


@pytest.mark.parametrize(
    ("has_photo", "match", "is_applied", "words"),
    [
        (False, "", False, ["Open: next step", "Sent?", "Match", "Apply"]),
        (True, "", False, ["Open: done", "Sent?: next step", "Match", "Apply"]),
        (True, "sure", False, ["Open: done", "Sent?: done", "Match: done", "Apply: next step"]),
        (True, "sure", True, ["Open: done", "Sent?: done", "Match: done", "Apply: done"]),
        (True, "earlier", True, ["Open: done", "Sent?: done", "Match: next step", "Apply"]),
        (True, "doubtful", False,
         ["Open: done", "Sent?: done", "Match: doubtful", "Apply: next step"]),
    ],
)  # fmt: skip
def test_each_step_says_how_far_it_is(
    steps: PhotoSteps, has_photo: bool, match: str, is_applied: bool, words: list[str]
) -> None:
    steps.show_state(has_photo=has_photo, match=match, is_applied=is_applied)
    assert names_of_steps(steps) == words
    assert (steps.buttons["match"].text() == "? Match") == (match == "doubtful")
    enabled = [name for name, button in steps.buttons.items() if button.isEnabled()]
    able = 1 if not has_photo else 4 if match in {"sure", "doubtful"} else 3
    assert enabled == list(STEPS)[:able]


def test_a_scene_that_differs_by_rounding_is_the_matched_one(
    view: LiveView, photo: Photo, match: Match
) -> None:
    scene = match.scene
    brighter = scene.replace(luminance=scene.transmitter.luminance * (1.0 + 1e-10))
    view.open(photo)
    view.show_matched(match)
    for shown, word in ((brighter, "done"), (scene.replace(luminance=4e3), "next step")):
        view.change(scene=shown)
        assert names_of_steps(view.steps)[3] == f"Apply: {word}"
        told = {chip.text for chip in view.verdict.badges.badges}
        assert ("not applied" in told) == (word != "done")


def test_the_pane_leads_from_step_to_step(view: LiveView, qtbot: QtBot, photo: Photo) -> None:
    view.open(None)
    assert names_of_steps(view.steps)[0] == "Open: next step"
    with qtbot.waitSignal(view.open_asked):
        view.steps.buttons["open"].click()
    view.open(photo)
    assert names_of_steps(view.steps)[1] == "Sent?: next step"
    view.steps.buttons["sent"].click()
    assert view.focusWidget() is view.form.sent
    with qtbot.waitSignal(view.form.asked):
        view.steps.buttons["match"].click()
