"""Steps of a photo: each says whether it is done, is next or must wait."""

from functools import partial

import pytest
from gui.photo.photo_bench import LiveView
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QCommonStyle
from pytestqt.qtbot import QtBot

from occ_gui.photo.photo_steps import STEPS, PhotoSteps
from occ_model.photo.reading.load import Photo
from occ_model.results.match import Match


@pytest.fixture
def steps(qtbot: QtBot) -> PhotoSteps:
    made = PhotoSteps()
    qtbot.addWidget(made)
    return made


def spoken(steps: PhotoSteps) -> list[str]:
    """Return what a screen reader says of the steps."""
    faces = [QAccessible.queryAccessibleInterface(button) for button in steps.buttons.values()]
    return [face.text(QAccessible.Text.Name) for face in faces]


@pytest.mark.parametrize(
    ("has_photo", "match", "is_applied", "words"),
    [
        (False, "", False, ["Open: next step", "Sent?", "Match", "Apply"]),
        (True, "", False, ["Open: done", "Sent?: next step", "Match", "Apply"]),
        (True, "sure", False, ["Open: done", "Sent?: done", "Match: done", "Apply: next step"]),
        (True, "sure", True, ["Open: done", "Sent?: done", "Match: done", "Apply: done"]),
        (True, "earlier", True, ["Open: done", "Sent?: done", "Match: next step", "Apply"]),
        (True, "doubtful", False, ["Open: done", "Sent?: done", "Match: doubtful", "Apply"]),
    ],
)  # fmt: skip
def test_each_step_says_how_far_it_is(
    steps: PhotoSteps, has_photo: bool, match: str, is_applied: bool, words: list[str]
) -> None:
    steps.show_state(has_photo=has_photo, match=match, is_applied=is_applied)
    assert [said.removesuffix(": next step") for said in spoken(steps)] == [
        word.removesuffix(": next step") for word in words
    ]
    enabled = [name for name, button in steps.buttons.items() if button.isEnabled()]
    assert enabled == list(
        STEPS[: 1 if not has_photo else 4 if match in {"sure", "doubtful"} else 3]
    )


def test_a_doubtful_match_has_no_tick(steps: PhotoSteps) -> None:
    steps.show_state(has_photo=True, match="doubtful", is_applied=False)
    assert steps.buttons["match"].text() == "? Match"


def test_an_earlier_match_is_no_step_towards_the_present_one(
    view: LiveView, photo: Photo, match: Match
) -> None:
    view.open(photo)
    view.show_matched(match)
    assert spoken(view.steps)[2:] == ["Match: done", "Apply: done"]
    view.show_match_outdated("of another part of the photo: match again", usable=False)
    assert spoken(view.steps)[2:] == ["Match: next step", "Apply"]
    assert not view.steps.buttons["apply"].isEnabled()
    view.show_match_outdated("", usable=True)
    assert spoken(view.steps)[2:] == ["Match: done", "Apply: done"]


def test_a_scene_that_differs_by_rounding_is_the_matched_one(
    view: LiveView, photo: Photo, match: Match
) -> None:
    scene = match.scene
    brighter = scene.replace(luminance=scene.transmitter.luminance * (1.0 + 1e-10))
    view.open(photo)
    view.show_matched(match)
    for shown, word in ((brighter, "done"), (scene.replace(luminance=4e3), "next step")):
        view.show_scene(shown)
        assert spoken(view.steps)[3] == f"Apply: {word}"
        told = {chip.text for chip in view.verdict.chips.chips}
        assert ("not applied" in told) == (word != "done")


def test_a_click_goes_to_its_step(steps: PhotoSteps) -> None:
    told: list[str] = []
    steps.chosen.connect(told.append)
    steps.show_state(has_photo=True, match="sure", is_applied=False)
    for button in steps.buttons.values():
        button.click()
    assert told == list(STEPS)


def test_the_pane_leads_from_step_to_step(qtbot: QtBot, photo: Photo) -> None:
    view = LiveView()
    qtbot.addWidget(view)
    view.show()
    with qtbot.waitSignal(view.open_asked):
        view.steps.buttons["open"].click()
    view.open(photo)
    assert spoken(view.steps)[1] == "Sent?: next step"
    view.steps.buttons["sent"].click()
    assert view.focusWidget() is view.form.sent
    with qtbot.waitSignal(view.form.asked):
        view.steps.buttons["match"].click()
    view.open(None)
    assert spoken(view.steps)[0] == "Open: next step"


def test_the_steps_stand_as_far_from_what_is_above_as_from_what_is_below(steps: PhotoSteps) -> None:
    layout = steps.layout()
    assert layout is not None
    margins = layout.contentsMargins()
    assert margins.top() == margins.bottom()
    assert margins.left() == margins.right()


def test_steps_are_styled_anew_only_where_they_change(
    steps: PhotoSteps, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At each move of a slider they are told of the scene."""
    styled: list[str] = []

    def note(name: str) -> QCommonStyle:
        styled.append(name)
        return QCommonStyle()

    for name, button in steps.buttons.items():
        monkeypatch.setattr(button, "style", partial(note, name))
    steps.show_state(has_photo=False, match="", is_applied=False)
    assert not styled
    steps.show_state(has_photo=True, match="", is_applied=False)
    assert set(styled) == set(STEPS)
