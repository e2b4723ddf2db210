"""Effects switched by hand are always listed on the screen, and one click resets them all."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from gui.user import User
from PySide6.QtCore import QRect

from occ_gui.app import features
from occ_gui.app.application import Application
from occ_gui.core.workspace import FIRST_SETTINGS
from occ_gui.files import preset_controller
from occ_gui.scene.forced_effects import accuracy_badge
from occ_gui.values.modes import MODES
from occ_gui.widgets.state_look import BadgeLabel, State
from occ_model.effects.registry import EFFECTS
from occ_model.scene.presets import load_preset, preset_named, presets
from occ_model.scene.scene import Scene


def forced_effects(application: Application) -> dict[str, bool]:
    return dict(application.settings.settings.force)


def small(name: str) -> Scene:
    return load_preset(name).replace(rows=200)


def make_presets_small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        preset_controller,
        "preset_named",
        lambda name: replace(preset_named(name), scene=small(name)),
    )
    monkeypatch.setattr(features, "load_preset", small)


@pytest.fixture
def by_hand(application: Application, user: User) -> Application:
    application.scene_store.force("jpeg", False)
    application.scene_store.force("vignetting", True)
    user.wait_until_idle()
    return application


@pytest.mark.parametrize(
    ("settings", "text"),
    [
        ({"tolerance": 10.0}, "tolerance 10 levels"),
        ({"tolerance": math.inf}, "paper's model, no effects"),
        (
            {"tolerance": 2.0, "observable": "decision"},
            "tolerance 2 margins of the decision",
        ),
        ({"force": {"jpeg": False}}, "JPEG switched off"),
        ({"force": {"jpeg": False, "flicker": True}}, "2 effects switched"),
    ],
)  # fmt: skip
def test_what_is_set_by_hand_is_one_badge(settings: dict[str, Any], text: str) -> None:
    labels = {effect.name: effect.label for effect in EFFECTS}
    badge = accuracy_badge(replace(FIRST_SETTINGS, **settings), labels)
    assert badge.text == text
    assert badge.state is (State.DOUBTFUL)
    for effect in settings.get("force", {}):
        assert labels[effect] in badge.meaning
    assert accuracy_badge(FIRST_SETTINGS, labels) is None


def test_the_badge_is_always_whole_on_the_screen(application: Application, user: User) -> None:
    """Check every mode, beside the longest messages, in small and large windows."""
    window = application.window
    application.settings.set_tolerance(10.0)
    for effect in ("jpeg", "flicker", "defocus"):
        application.scene_store.force(effect, False)
    badges = window.statusBar().findChildren(BadgeLabel)
    (badge,) = (badge for badge in badges if badge.badge.key == "accuracy")
    for width, height in ((1024, 700), (1920, 1080)):
        window.resize(width, height)
        for mode in MODES:
            window.modes.switch(mode)
            window.show_message("Switching frequency is '1,000 Hz', which means 1 Hz. " * 9)
            window.readout.set_full_text("Picture: column 1234, row 1200, camera level 123")
            user.wait_until_idle()
            assert badge.isVisible()
            assert badge.badge.text == "tolerance 10 levels · 3 effects switched"
            assert badge.width() >= badge.sizeHint().width()
            place = QRect(badge.mapTo(window, badge.rect().topLeft()), badge.size())
            assert window.rect().contains(place)
            assert badge.visibleRegion().boundingRect() == badge.rect()
    window.modes.switch("explore")


def test_another_scene_is_simulated_within_the_usual_tolerance(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_presets_small(monkeypatch)
    path = tmp_path / "own.toml"
    path.write_text(small("tablet-61us").to_toml(), encoding="utf-8")
    for begin in (
        user.choose_next_preset,
        lambda: user.choose("Reset &scene"),
        lambda: application.files.open_scene(path),
    ):
        application.settings.set_tolerance(10.0)
        application.settings.set_observable("signal")
        application.scene_store.force("jpeg", False)
        begin()
        user.wait_until_idle()
        assert application.settings.settings == FIRST_SETTINGS
        assert not application.controls.forced.isVisible()
    application.settings.set_tolerance(10.0)
    assert application.controls.forced.text.text() == "Tolerance 10 levels"
    application.controls.forced.back.click()
    assert application.settings.settings == FIRST_SETTINGS


def test_a_click_a_preset_or_a_reset_ends_listed_forced_effects_in_one_step(
    by_hand: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_presets_small(monkeypatch)
    line = by_hand.controls.forced
    assert line.isVisible()
    assert line.text.text() == "Vignetting switched on, JPEG switched off"
    line.back.click()
    user.wait_until_idle()
    assert forced_effects(by_hand) == {}
    assert not line.isVisible()
    by_hand.window.bring_to_front("accuracy")
    switches = by_hand.view("accuracy").table.switches.values()
    assert {switch.currentText() for switch in switches} == {"plan"}
    user.choose("&Undo")
    assert forced_effects(by_hand) == {"jpeg": False, "vignetting": True}
    simulated: list[dict[str, bool]] = []
    by_hand.simulation.snapshot_shown.connect(
        lambda snapshot: simulated.append(dict(snapshot.request.settings.force))
    )
    user.choose_next_preset()
    assert by_hand.scene_store.scene in map(small, presets())
    assert simulated
    assert not any(simulated)  # neither in a draft nor in the picture
    user.choose("&Undo")
    assert forced_effects(by_hand) == {"jpeg": False, "vignetting": True}
    for _ in range(2):  # the second reset leaves the scene unchanged
        user.choose("Reset &scene")
        assert forced_effects(by_hand) == {}
        by_hand.scene_store.force("jpeg", True)
