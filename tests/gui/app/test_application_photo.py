"""A photo in the window: opened, matched, applied to the scene, and placed by hand."""

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gui.user import PATIENCE_S, User
from PIL import Image
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.values.choices import Placement
from occ_model.errors import MatchError
from occ_model.photo.comparison import RIM
from occ_model.scene.scene import Scene

SENT = {"readout_time": 11e-6, "exposure_time": 90e-6, "switching_frequency": 4e3}
"""Parameters of the simulated photo."""


@pytest.fixture
def camera_scene(small_scene: Scene) -> Scene:
    """Fill a small picture with a panel that blinks."""
    small = small_scene.replace(pattern="10", rows=120, columns=700, enhancement="none")
    return small.replace(distance=0.05, **SENT)


@pytest.fixture
def photo_path(tmp_path: Path, camera_scene: Scene) -> Path:
    path = tmp_path / "taken.png"
    Image.fromarray(occ.render(camera_scene).image).save(path)
    return path


def choose_lamp(application: Application) -> None:
    """Enter what the lamp of the photo sends."""
    form = application.view("photo").form
    form.sent.show_key("lamp")
    form.lamp.set_value(SENT["switching_frequency"] / 2)


@pytest.fixture
def matched(
    application: Application, user: User, photo_path: Path, remembered_matches: None
) -> Application:
    user.open_photo(photo_path)
    choose_lamp(application)
    user.choose("&Match photo")
    return application


def test_opening_a_photo_brings_its_pane_to_the_front_once(
    qtbot: QtBot, application: Application, user: User, photo_path: Path
) -> None:
    docks = application.window.docks
    user.open_photo(photo_path)
    qtbot.waitUntil(lambda: not docks["photo"].visibleRegion().isEmpty())
    assert application.results_store.results.document.match_request is None
    application.window.modes.switch("explore")
    user.choose("&Line by line")
    QApplication.processEvents()
    assert application.window.modes.mode == "explore"


def test_reading_a_photo_shows_progress_and_a_cancel_button(
    application: Application,
    user: User,
    photo_path: Path,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    is_released = threading.Event()
    load = occ.load_photo

    def wait_and_load(*args: Any, progress: Callable[[float], object], **options: Any) -> occ.Photo:
        progress(0.5)
        assert is_released.wait(PATIENCE_S)
        return load(*args, progress=progress, **options)

    monkeypatch.setattr(occ, "load_photo", wait_and_load)
    bar = application.window.loading_bar
    application.photos.open(photo_path, match=True)
    qtbot.waitUntil(bar.isVisible)
    qtbot.waitUntil(lambda: bar.progress.value() == bar.progress.maximum() // 2)
    bar.cancel.click()
    assert not bar.isVisible()
    assert application.shell.pane("photo").is_idle
    is_released.set()
    user.open_photo(photo_path)
    assert not bar.isVisible()
    assert application.shell.pane("photo").matching.photo is not None
    assert application.shell.pane("photo").matching.match is None


def test_a_match_finds_the_readout_time_and_applying_it_in_one_step_places_the_photo(
    matched: Application, user: User, small_scene: Scene
) -> None:
    assert matched.scene_store.scene == small_scene
    match = matched.shell.pane("photo").matching.match
    assert match.readout_time == pytest.approx(SENT["readout_time"], rel=5e-3)
    steps = matched.scene_store.undo_stack.count()
    user.choose("&Apply to the scene")
    assert matched.scene_store.undo_stack.count() == steps + 1
    assert matched.scene_store.scene == match.scene
    user.choose("&Undo")
    assert matched.scene_store.scene == small_scene
    overlay = matched.view("picture").overlay
    corner = overlay.placement
    assert corner != Placement()
    matched.view("photo").result.apply.click()
    user.wait_until_idle()
    assert overlay.placement == Placement()
    columns, levels = matched.view("profile").photo.getOriginalDataset()
    assert columns[0] == match.region.first_column + RIM
    simulated = matched.view("profile").simulation.getOriginalDataset()[1][columns.astype(int)]
    assert np.corrcoef(levels, simulated)[0, 1] > 0.98
    user.choose("&Undo")
    assert overlay.placement == corner
    before = overlay.placement
    matched.view("photo").placement.by_mouse.click()
    assert matched.view("picture").mode.key() == "blend"
    assert overlay.frame.isVisible()
    overlay.frame.setPos((199.5, 49.5))
    assert overlay.placement == Placement(200.0, 50.0)
    assert matched.view("photo").placement.column.value() == 200.0
    columns, _ = matched.view("profile").photo.getOriginalDataset()
    assert columns[0] == 200 + match.region.first_column + RIM
    matched.view("photo").placement.reset.click()
    assert overlay.placement == before


def test_a_photo_is_drawn_in_the_story_only_where_the_scene_comes_from_its_match(
    matched: Application, user: User, small_scene: Scene
) -> None:
    rows = matched.story.rows
    user.wait_until_idle()
    assert rows.profile.photo is None, "it shows something else than the scene"
    assert {"fitted", "photo"}.isdisjoint(rows.legend.keys)
    assert matched.view("profile").photo_levels is not None
    matched.view("photo").result.apply.click()
    scene = matched.scene_store.scene
    for changed in (scene, scene.replace(exposure_time=9e-5, iso=150.0)):
        matched.scene_store.put(changed, "sliders")
        user.wait_until_idle()
        photo, levels = rows.profile.photo, matched.view("profile").photo_levels
        assert photo is not None
        assert levels is not None
        np.testing.assert_array_equal(photo[1], levels)
        assert "fitted" in rows.legend.keys
    matched.scene_store.put(occ.load_preset("phone-136us"), "preset")
    user.wait_until_idle()
    assert rows.profile.photo is None
    user.choose("&Undo")
    user.wait_until_idle()
    assert rows.profile.photo is not None
    matched.photos.close()
    user.wait_until_idle()
    assert rows.profile.photo is None


def test_match_actions_are_enabled_with_a_photo_or_a_match(
    application: Application, user: User, photo_path: Path, remembered_matches: None
) -> None:
    actions = application.window.actions_by_name
    with_photo, with_match = ("match", "use_settings"), ("apply_match", "save_match")
    user.open_photo(photo_path)
    assert all(actions[name].isEnabled() for name in with_photo)
    assert not any(actions[name].isEnabled() for name in with_match)
    choose_lamp(application)
    user.choose("&Match photo")
    assert all(actions[name].isEnabled() for name in with_match)
    application.photos.close()
    assert not any(actions[name].isEnabled() for name in (*with_photo, *with_match))


def test_the_menu_finds_the_lamps_of_a_photo(
    application: Application, user: User, photo_path: Path, qtbot: QtBot
) -> None:
    user.open_photo(photo_path)
    user.choose("&Find lamps")
    qtbot.waitUntil(lambda: len(application.photos.document.lamps) == 1)


def test_only_a_match_requested_with_the_photo_is_applied_automatically(
    application: Application, user: User, photo_path: Path, monkeypatch: pytest.MonkeyPatch,
    remembered_matches: None,
) -> None:  # fmt: skip
    def refuse(*_args: object, **_options: object) -> None:
        raise MatchError("No scene explains these stripes.")

    matching = application.shell.pane("photo").matching
    application.scene_store.change(pattern="10", switching_frequency=SENT["switching_frequency"])
    scene = application.scene_store.scene
    with monkeypatch.context() as patched:
        patched.setattr(occ, "match_photo", refuse)
        application.photos.open(photo_path, match=True)
        user.wait_until_idle()
        user.wait_until_idle()
    assert "No scene explains" in user.message
    application.photos.open(photo_path)
    user.wait_until_idle()
    assert matching.match is None
    user.choose("&Match photo")
    assert matching.match is not None
    assert application.scene_store.scene == scene
    application.photos.close()
    application.photos.open(photo_path, match=True)
    user.wait_until_idle()
    user.wait_until_idle()
    readout = application.scene_store.scene.camera.readout_time
    assert readout == pytest.approx(SENT["readout_time"], rel=5e-3)


def test_the_mode_photo_shows_the_verdict_on_the_photo_instead_of_the_simulations(
    matched: Application, user: User
) -> None:
    story, verdict = matched.story, matched.view("photo").verdict
    assert matched.window.modes.mode == "photo"
    assert verdict.isVisible()
    assert not story.verdict.isVisible()
    match = matched.shell.pane("photo").matching.match
    assert verdict.heading.startswith(f"Photo: {match.verdict}")
    badges = {badge.key: badge for badge in verdict.badges.badges}
    simulation = badges["simulation"]
    assert (simulation.text, simulation.state) == (story.verdict.heading, story.verdict.state)
    assert story.verdict.heading.startswith("Simulation: ")
    assert "applied" in badges
    user.choose("&Apply to the scene")
    assert "applied" not in {badge.key for badge in verdict.badges.badges}
    matched.window.modes.switch("explore")
    assert story.verdict.isVisible()
    assert not verdict.isVisible()
    assert story.verdict.heading.startswith("Simulation: ")
    user.choose("&Close photo")
    assert not story.verdict.heading.startswith("Simulation: ")
