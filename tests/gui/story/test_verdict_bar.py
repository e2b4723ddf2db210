"""The verdict bar states in words and by shape whether each decoder read the code."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from gui.kinds import SnapshotOf, add_widget, collect, with_result
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.simulation.controller import simulate
from occ_gui.simulation.jobs import reading_by_profile
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.simulation.verdict import CodeVerdict
from occ_gui.story.verdict_bar import VerdictBar
from occ_gui.widgets.state_look import BadgeLabel, State
from occ_model.results.decoding import overexposed_text
from occ_model.scene.scene import Scene
from occ_model.simulation.render import plan_scene
from occ_model.teaching.lessons import lessons


@pytest.fixture
def bar(qtbot: QtBot) -> VerdictBar:
    bar = add_widget(qtbot, VerdictBar())
    bar.resize(900, 60)
    return bar


def texts(bar: VerdictBar) -> dict[str, str]:
    return {badge.key: badge.text for badge in bar.badges.badges}


def alter(snapshot: Snapshot, **changes: Any) -> Snapshot:
    return with_result(snapshot, replace(snapshot.results["threshold"], **changes))


def test_a_code_that_is_read_is_good_and_named_and_one_with_wrong_bits_is_doubtful(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    assert bar.state is State.WAITING
    bar.show_reading(snapshot_of())
    assert bar.state is State.GOOD
    assert bar.title.text() == "Code 718 read, all bits right"
    assert "each column sees 1 or 2 chips." in bar.accessibleDescription()
    snapshot = snapshot_of()
    bits = snapshot.results["threshold"].bits.copy()
    bits[[2, 5]] ^= 1
    bar.show_reading(alter(snapshot, code=1, bits=bits))
    assert (bar.state, bar.title.text()) == (State.DOUBTFUL, "Code 1 read, 2 of 10 bits wrong")
    bar.show_reading(alter(snapshot, code=1, bits=1 - snapshot.results["threshold"].bits))
    assert bar.state is State.BAD


def test_no_code_is_bad_and_the_reason_is_given(bar: VerdictBar, snapshot_of: SnapshotOf) -> None:
    none, reason = np.empty(0, dtype=np.uint8), "A chip lasts 0.5 columns: too few."
    bar.show_reading(alter(snapshot_of(), code=None, bits=none, failure=reason))
    assert (bar.state, bar.title.text()) == (State.BAD, "No code: a chip lasts 0.5 columns")
    assert bar.accessibleDescription().endswith("Too few.")


def test_the_cause_of_no_stripes_is_a_panel_that_the_receiver_does_not_find(
    bar: VerdictBar,
) -> None:
    snapshot = simulate(occ.load_preset("phone-68us").replace(panel_height=0.002))
    assert (snapshot.results["threshold"].failure or "").startswith("No stripes")
    bar.show_reading(snapshot)
    assert bar.title.text() == "No code: the panel is not found"
    assert bar.step.text().startswith("Mark the brightest 0.")


def test_a_raw_pattern_is_neither_good_nor_bad_and_a_slow_decoder_is_waited_for(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    bar.show_reading(snapshot_of(pattern="010100010110001001000"))
    assert (bar.state, bar.title.text()) == (State.NEUTRAL, "No code is sent")
    assert "raw chip pattern" in bar.accessibleDescription()
    bar.show_reading(snapshot_of())
    bar.choose_decoder("slow")
    assert (bar.state, bar.title.text()) == (State.WAITING, "Reading by the decoder slow")
    assert "takes longer" in bar.accessibleDescription()


def test_an_outdated_verdict_and_one_before_the_picture_are_marked(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    bar.show_reading(snapshot_of())
    bar.show_outdated(True)
    assert bar.state is State.WAITING
    assert bar.title.text() == "Earlier scene: Code 718 read, all bits right"
    assert texts(bar)["computing"] == "computing"
    bar.show_outdated(False)
    assert bar.state is State.GOOD
    assert "computing" not in texts(bar)
    early = replace(snapshot_of(), source="profile", has_picture=False)
    bar.show_reading(early)
    assert (bar.state, texts(bar)["computing"]) == (State.GOOD, "computing the picture")
    bar.show_reading(replace(early, has_picture=True))
    assert "computing" not in texts(bar)
    bar.show_reading(early)
    bar.show_reading(snapshot_of())
    assert "computing" not in texts(bar)


def test_a_scene_without_a_picture_has_no_verdict(bar: VerdictBar, snapshot_of: SnapshotOf) -> None:
    bar.show_reading(snapshot_of())
    bar.show_failure("The panel is behind the camera.")
    assert (bar.state, bar.title.text()) == (State.BAD, "No picture of this scene")
    assert "behind the camera" in bar.accessibleDescription()
    assert not bar.badges.badges
    bar.show_reading(snapshot_of())
    assert bar.state is State.GOOD


def test_a_badge_shows_the_exposure_in_chips(bar: VerdictBar, snapshot_of: SnapshotOf) -> None:
    bar.show_reading(snapshot_of())
    assert texts(bar)["ratio"] == "t / t<sub>LED</sub> = 0.68"
    bar.show_reading(snapshot_of(exposure_time=136e-6))
    assert texts(bar)["ratio"] == "t / t<sub>LED</sub> = 1.36"
    assert (
        "each column averages 2 or 3 chips; different codes give different averages"
        in bar.accessibleDescription()
    )


def test_a_good_verdict_states_a_large_error(bar: VerdictBar, small_scene: Scene) -> None:
    snapshot = simulate(small_scene)
    bar.show_reading(snapshot)
    assert bar.heading == "Code 718 read, all bits right"
    for settings in (
        replace(FIRST_SETTINGS, tolerance=math.inf), replace(FIRST_SETTINGS, tolerance=30.0),
        replace(FIRST_SETTINGS, force={"sensor-noise": False}),
    ):  # fmt: skip
        rough = simulate(small_scene, settings)
        assert rough.error == rough.plan.error > 0.5
        bar.show_reading(rough)
        heading = f"Code 718 read, all bits right (up to {rough.error:.2g} levels left out)"
        assert bar.heading == heading
    # Before its picture is there, too.
    planned = plan_scene(small_scene, rough.request.settings)
    early = reading_by_profile(rough.request, planned)
    bar.show_reading(early)
    assert bar.heading == heading
    bar.show_reading(replace(snapshot, error=math.inf))
    assert bar.heading.endswith("(an unknown part left out)")


def test_the_badge_for_a_picture_to_come_is_never_cut(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    early = replace(snapshot_of(exposure_time=136e-6), source="draft", has_picture=False)
    bar.show()
    for width in (900, 500, 420):
        bar.resize(width, 60)
        bar.show_reading(early)
        shown = [label for label in bar.findChildren(BadgeLabel) if not label.isHidden()]
        (waiting,) = [label for label in shown if label.badge.key == "computing"]
        assert waiting.width() >= waiting.sizeHint().width()
        assert bar.badges.rect().contains(waiting.geometry())


def test_the_verdict_is_that_of_the_chosen_decoder(bar: VerdictBar, small_scene: Scene) -> None:
    scene = small_scene.replace(exposure_time=136e-6, switching_frequency=20e3)
    snapshot = simulate(scene)
    assert snapshot.results["threshold"].code is None
    assert occ.decode(snapshot.frame.image, scene, decoder="matched").code == 718
    bar.show_reading(snapshot)
    assert bar.state is State.BAD
    (others,) = [badge for badge in bar.badges.badges if badge.key == "others"]
    assert others.text.startswith("read by: ")
    assert "matched" in others.meaning
    bar.choose_decoder("matched")
    assert bar.state is State.GOOD
    assert not any("matched" in b.meaning for b in bar.badges.badges if b.key == "others")


@pytest.mark.parametrize("width", [900, 230, 120])
def test_badges_that_do_not_fit_are_counted(
    bar: VerdictBar, small_scene: Scene, width: int
) -> None:
    bar.show()
    bar.show_reading(simulate(small_scene.replace(exposure_time=136e-6)))
    row = bar.badges
    row.resize(width, 22)
    shown = [label for label in row.findChildren(BadgeLabel) if not label.isHidden()]
    assert all(label.x() >= 0 for label in shown)
    hidden = len(row.badges) - sum(label.badge in row.badges for label in shown)
    assert (hidden == 0) == (width == 900)
    assert any(label.badge.text == f"+ {hidden}" for label in shown) == (hidden > 0)
    count, badges = len(row.findChildren(BadgeLabel)), row.badges
    for some in ((), badges):
        row.show_badges(some)
    assert len(row.findChildren(BadgeLabel)) == count  # making them takes long


def test_the_simulation_is_named_where_a_photo_is_shown_too(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    bar.show_reading(snapshot_of())
    bar.name_simulation(True)
    assert bar.heading == "Simulation: code 718 read, all bits right"
    bar.show_outdated(True)
    assert bar.heading == "Simulation of the earlier scene: code 718 read, all bits right"
    bar.name_simulation(False)
    assert bar.heading == "Earlier scene: Code 718 read, all bits right"


def test_a_narrow_bar_says_the_same_in_fewer_words(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    bar.show()
    bar.show_reading(snapshot_of())
    whole = bar.accessibleDescription()
    for width in (900, 600, 400):
        bar.resize(width, 60)
        assert "…" not in bar.sentence.text()
        assert bar.title.geometry().left() > bar.icon.geometry().right()
    assert "2 chips a column" in bar.sentence.text()
    assert bar.accessibleDescription() == whole


def test_while_a_slider_runs_the_verdict_names_its_value_and_that_of_the_picture(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    bar.show_reading(snapshot_of())
    bar.show_run("Distance 1.2 m", "1.1 m")
    assert bar.state is State.GOOD
    assert bar.heading == "Distance 1.2 m: code 718 read, all bits right"
    assert texts(bar)["computing"] == "picture: 1.1 m"
    bar.show_run("Distance 1.2 m", "")
    assert "computing" not in texts(bar)
    bar.show_run("", "")
    assert bar.heading == "Code 718 read, all bits right"


def test_a_slow_decoder_that_was_chosen_earlier_is_not_named_beside_the_quick_ones(
    bar: VerdictBar, small_scene: Scene
) -> None:
    snapshot = simulate(small_scene)
    bar.show_reading(snapshot)
    before = bar.badges.badges
    matched = snapshot.results["matched"]
    bar.show_reading(with_result(snapshot, replace(matched, decoder="sequence")))
    assert bar.badges.badges == before


def test_the_cause_comes_first_and_its_step_is_a_button(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    steps = collect(bar.step_chosen)
    bar.show_reading(snapshot_of(exposure_time=136e-6, switching_frequency=20e3))
    assert bar.title.text() == "No code: beyond the null at 14.7 kHz"
    assert "leaves 26 % of the swing of alternating chips." in bar.accessibleDescription()
    assert bar.step.text() == "Try the matched decoder"
    bar.step.click()
    assert [step.decoder for step in steps] == ["matched"]
    bar.show_reading(snapshot_of())
    assert bar.step.isHidden()


def test_overexposure_is_the_heading_where_it_is_the_cause_and_else_a_badge(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    read = snapshot_of(exposure_time=136e-6, iso=6400.0)
    bar.show_reading(read)
    assert bar.heading == "Code 718 read, all bits right"
    assert texts(bar)["overexposed"].startswith("overexposed: 66 %")
    white = snapshot_of(exposure_time=136e-6, iso=12800.0)
    bar.show_reading(white)
    assert bar.heading == "No code: overexposed"
    assert bar.step.text() == "Set ISO 501"
    bits = np.array(white.sent, dtype=np.uint8)
    bits[[2, 5]] ^= 1
    bar.show_reading(alter(white, code=1, bits=bits, failure=None))
    assert bar.heading == "Code 1 read, 2 of 10 bits wrong: overexposed"
    assert "each column sees" not in bar.accessibleDescription()
    bar.show_reading(snapshot_of(exposure_time=136e-6, iso=6400.0, switching_frequency=20e3))
    assert bar.heading == "No code: beyond the null at 14.7 kHz"
    bar.show_reading(snapshot_of())
    assert "overexposed" not in texts(bar)


@pytest.mark.parametrize(
    ("fraction", "text"), [(1.0, "100 %"), (0.996, "100 %"), (0.0123, "1.2 %")]
)
def test_the_overexposed_fraction_is_written_without_an_exponent(
    bar: VerdictBar, snapshot_of: SnapshotOf, fraction: float, text: str
) -> None:
    bar.show_reading(replace(snapshot_of(), overexposed=fraction))
    assert texts(bar)["overexposed"] == f"overexposed: {text}"
    assert overexposed_text(fraction).startswith(f"Overexposed: {text} of the panel's columns")


def test_before_the_cause_is_known_no_symptom_is_the_title(
    bar: VerdictBar, snapshot_of: SnapshotOf
) -> None:
    unread = snapshot_of(exposure_time=136e-6, switching_frequency=20e3)
    bar.show_reading(replace(unread, causes=None))
    assert bar.heading == "No code read"
    assert bar.accessibleDescription() == f"No code read. {unread.results['threshold'].failure}"
    wrong = alter(unread, code=1, bits=1 - np.array(unread.sent, dtype=np.uint8), failure=None)
    bar.show_reading(replace(wrong, causes={}))
    assert bar.accessibleDescription().endswith("The decoder does not detect this.")


def test_a_code_read_from_exposures_above_the_period_leads_to_its_lesson(
    bar: VerdictBar, snapshot_of: SnapshotOf, qtbot: QtBot
) -> None:
    bar.show_reading(snapshot_of(exposure_time=136e-6, switching_frequency=5.5e3))
    assert bar.step.isHidden()
    bar.show_reading(snapshot_of(exposure_time=136e-6, switching_frequency=10e3))
    assert bar.state is State.GOOD
    with qtbot.waitSignal(bar.lesson_requested) as signal:
        bar.step.click()
    names = {lesson.name for lesson in lessons().lessons}
    assert signal.args[0] in names
    bar.show_outdated(True)
    assert bar.step.isHidden()


@pytest.mark.parametrize(
    ("state", "reason", "heading", "explanation"),
    [
        (State.BAD, "No header fits: come closer.", "No code: no header fits", "Come closer."),
        (State.BAD, "No header, two needed: 9 fit.", "No code: no header", "Two needed: 9 fit."),
        (State.BAD, "No header fits.", "No code: no header fits", ""),
        (State.BAD, "No code stands out: 1, 2.", "No code stands out", "1, 2."),
        (State.BAD, "", "Title", ""),
        (State.DOUBTFUL, "Half fits: look.", "Title", "Half fits: look."),
    ],
)
def test_the_reason_is_divided_between_heading_and_explanation(
    state: State, reason: str, heading: str, explanation: str
) -> None:
    verdict = CodeVerdict(state, "Title", reason)
    assert verdict.heading == heading
    assert verdict.explanation == explanation


def test_the_verdict_on_one_of_three_colours_names_it_and_leads_to_all(
    bar: VerdictBar, snapshot_of: SnapshotOf, qtbot: QtBot
) -> None:
    bar.show_reading(snapshot_of(exposure_time=136e-6, switching_frequency=10e3))
    bar.name_colour("green")
    assert bar.heading == "Green: code 718 read, all bits right"
    with qtbot.waitSignal(bar.colours_requested):
        bar.step.click()
    bar.name_colour("")
    assert bar.heading == "Code 718 read, all bits right"
