"""Effects switched by hand are listed where they are seen, and one click ends them all."""

from dataclasses import replace

import pytest
from gui.user import User

from occ_gui.app import features
from occ_gui.app.application import Application
from occ_gui.files import preset_controller
from occ_gui.scene.forced_effects import forced_text
from occ_model.effects.registry import EFFECTS
from occ_model.scene.preset_file import Preset
from occ_model.scene.presets import load_preset, preset_named
from occ_model.scene.scene import Scene


def forced(application: Application) -> dict[str, bool]:
    return dict(application.settings.settings.force)


@pytest.fixture
def by_hand(application: Application, user: User) -> Application:
    application.store.force("jpeg", False)
    application.store.force("vignetting", True)
    user.wait_until_idle()
    return application


def test_each_forced_effect_is_named_in_the_order_of_light() -> None:
    labels = {effect.name: effect.label for effect in EFFECTS}
    assert forced_text({"jpeg": False, "vignetting": True}, labels) == (
        "Vignetting on by hand, JPEG off by hand"
    )
    everything = forced_text({effect.name: True for effect in reversed(EFFECTS)}, labels)
    assert everything.split(", ") == [f"{effect.label} on by hand" for effect in EFFECTS]


def test_forced_effects_are_listed_and_end_by_a_click_another_preset_and_a_reset_in_one_step(
    by_hand: Application, user: User, monkeypatch: pytest.MonkeyPatch
) -> None:
    listed = by_hand.controls.forced
    assert listed.isVisible()
    assert listed.text.text() == "Vignetting on by hand, JPEG off by hand"
    listed.back.click()
    user.wait_until_idle()
    assert forced(by_hand) == {}
    assert not listed.isVisible()
    switches = by_hand.view("accuracy").table.switches.values()
    assert {switch.currentText() for switch in switches} <= {"auto"}
    user.choose("&Undo")
    assert forced(by_hand) == {"jpeg": False, "vignetting": True}
    chosen: list[str] = []

    def small(name: str) -> Scene:
        return load_preset(name).replace(rows=200)

    def small_preset(name: str) -> Preset:
        chosen.append(name)
        return replace(preset_named(name), scene=small(name))

    monkeypatch.setattr(preset_controller, "preset_named", small_preset)
    monkeypatch.setattr(features, "load_preset", small)
    simulated: list[dict[str, bool]] = []
    by_hand.simulation.snapshot_shown.connect(
        lambda snapshot: simulated.append(dict(snapshot.request.settings.force))
    )
    user.choose_next_preset()
    assert by_hand.store.scene == small(chosen[-1])
    assert simulated == [{}]
    user.choose("&Undo")
    assert forced(by_hand) == {"jpeg": False, "vignetting": True}
    for _ in range(2):  # the second time of the scene that it already is
        user.choose("Reset &scene")
        assert forced(by_hand) == {}
        by_hand.store.force("jpeg", True)
