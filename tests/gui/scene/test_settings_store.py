"""The settings change in one place, and emit a signal only when they do."""

import pytest
from gui.stores import store_of

from occ_model.scene.simulation_settings import SimulationSettings


class Told:
    """A store and what it tells."""

    def __init__(self) -> None:
        self.scenes = store_of()
        self.store = self.scenes.settings
        self.changes: list[SimulationSettings] = []
        self.refusals: list[str] = []
        self.store.changed.connect(self.changes.append)
        self.store.refused.connect(self.refusals.append)

    def switch(self, force: dict[str, bool]) -> None:
        """Switch effects by hand."""
        self.scenes.put(self.scenes.scene, "switch", force=force)


@pytest.fixture
def told() -> Told:
    return Told()


def test_noise_is_reused_at_first_and_else_defaults_hold(told: Told) -> None:
    assert told.store.settings == SimulationSettings(noise="reused")


def test_each_change_is_emitted_once_and_leaves_the_rest(told: Told) -> None:
    told.store.set_tolerance(2.0)
    told.store.set_observable("profile")
    told.store.set_noise("exact")
    told.switch({"jpeg": True})
    told.switch({"jpeg": True, "flicker": False})
    told.switch({"flicker": False})
    assert told.store.settings == SimulationSettings(2.0, "profile", {"flicker": False}, "exact")
    assert told.changes[-1] == told.store.settings
    assert len(told.changes) == 6


def test_a_setting_that_holds_already_is_not_emitted(told: Told) -> None:
    told.store.set_tolerance(told.store.settings.tolerance)
    told.store.set_observable("image")
    told.store.set_noise("reused")
    told.switch({})
    assert told.changes == []


def test_settings_once_emitted_never_change(told: Told) -> None:
    force = {"jpeg": True}
    told.switch(force)
    before = told.changes[0]
    force["jpeg"] = False
    assert before.force == {"jpeg": True}


@pytest.mark.parametrize("tolerance", [-1.0, float("nan")])
def test_a_tolerance_that_cannot_be_is_refused_with_a_sentence(
    told: Told, tolerance: float
) -> None:
    told.store.set_tolerance(tolerance)
    (sentence,) = told.refusals
    assert sentence.startswith("Tolerance cannot be ")
    assert sentence.endswith(".")
    assert told.changes == []
