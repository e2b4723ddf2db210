"""Files in the window: opened by menu or drop, listed, shown in the panes, and saved."""

import shutil
from pathlib import Path

import pytest
from gui.user import User
from PIL import Image
from PySide6.QtWidgets import QMenu
from pytestqt.qtbot import QtBot

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.files import file_controller
from occ_model.scene.provenance import scene_inside
from occ_model.scene.scene import Scene


@pytest.fixture
def camera_scene(small_scene: Scene) -> Scene:
    """Fill a small picture with a panel that blinks."""
    small = small_scene.replace(pattern="10", rows=120, columns=700, enhancement="none")
    return small.replace(distance=0.05)


@pytest.fixture
def photo_copy(photo_file: Path) -> Path:
    return Path(shutil.copy(photo_file, photo_file.with_name("taken.png")))


def entries(menu: QMenu) -> list[str]:
    return [action.text() for action in menu.actions() if not action.isSeparator()]


@pytest.fixture
def samples(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, camera_scene: Scene) -> Path:
    """Replace the program's sample photos by one with its scene."""
    folder = tmp_path / "resources" / "photos"
    folder.mkdir(parents=True)
    Image.fromarray(occ.render(camera_scene).image).save(folder / "led-1khz-panel.jpg")
    (folder / "led-1khz-panel.toml").write_text(camera_scene.to_toml(), encoding="utf-8")
    monkeypatch.setattr(file_controller, "resource_path", tmp_path.joinpath("resources").joinpath)
    return folder


@pytest.mark.own_window
def test_a_sample_is_opened_with_its_scene_and_not_listed_as_recent(
    samples: Path, user: User, application: Application, camera_scene: Scene,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    menu = application.window.menus.samples
    assert entries(menu) == ["LED 1 kHz panel (simulated)"]
    menu.actions()[0].trigger()
    user.wait_until_idle()
    assert application.scene_store.scene == camera_scene
    assert application.window.windowTitle().startswith("led-1khz-panel.jpg")
    assert application.preferences.files == ()
    monkeypatch.setattr(file_controller, "resource_path", samples.joinpath)  # which has no folder
    application.window.menus.show_samples(
        file_controller.sample_photos(), application.files.open_photo
    )
    assert not menu.isEnabled()


def test_recent_files_are_listed_and_reopened_and_missing_ones_are_removed(
    application: Application, user: User, photo_copy: Path, photo_file: Path, tmp_path: Path
) -> None:
    recent = application.window.menus.recent
    assert not recent.isEnabled()
    scene = tmp_path / "a&b.toml"
    saved = application.scene_store.scene.replace(iso=99.0)
    scene.write_text(saved.to_toml(), encoding="utf-8")
    for path in (photo_copy, photo_file):
        user.open_photo(path)
    application.files.open_scene(scene)
    user.wait_until_idle()
    assert entries(recent) == ["a&&b.toml", "stripes.png", "taken.png", "&Clear this list"]
    application.scene_store.change(iso=321.0)
    for place, text in ((0, "a&&b.toml"), (2, "taken.png")):
        assert entries(recent)[place] == text
        recent.actions()[place].trigger()
        user.wait_until_idle()
    assert application.scene_store.scene == saved
    assert application.window.windowTitle().startswith("taken.png")
    user.choose("&Clear this list")
    assert not recent.isEnabled()
    user.open_photo(photo_file)
    photo_file.unlink()
    application.window.menus.recent.actions()[0].trigger()
    assert user.message == f"{photo_file} is no longer there."
    assert application.preferences.files == ()
    user.open_photo(photo_file)
    assert photo_file.name in user.message
    assert application.preferences.files == (), "a file that cannot be read is not listed"


def test_a_dropped_photo_and_scene_are_opened_and_ignored_files_are_reported(
    application: Application, user: User, photo_file: Path, photo_copy: Path, qtbot: QtBot,
    tmp_path: Path,
) -> None:  # fmt: skip
    scenes = [tmp_path / "one.toml", tmp_path / "other.toml"]
    saved = application.scene_store.scene.replace(iso=99.0)
    for scene in scenes:
        scene.write_text(saved.to_toml(), encoding="utf-8")
    application.window.dropped.emit([photo_file, *scenes])
    assert "only one.toml and stripes.png" in user.message
    user.wait_until_idle()
    assert application.scene_store.scene == saved
    assert application.window.windowTitle().startswith("stripes.png")
    # Photos that are dropped together become a table.
    application.window.dropped.emit([photo_file, photo_copy])
    user.wait_until_idle()
    assert application.view("photo").many.rows.paths == (photo_file, photo_copy)
    qtbot.waitUntil(lambda: application.view("photo").many.isVisible())  # across the bottom
    assert application.window.actions_by_name["match_all"].isEnabled()
    assert application.window.windowTitle().startswith("stripes.png")


TITLE = "Optical Camera Communication"


def test_an_open_photo_is_named_in_the_title_and_the_menu_turns_and_overlays_it(
    application: Application, user: User, photo_file: Path
) -> None:
    close = user.entry("&Close photo")
    assert application.window.windowTitle() == TITLE
    assert not close.isEnabled()
    user.open_photo(photo_file)
    assert application.window.windowTitle() == f"stripes.png – {TITLE}"  # noqa: RUF001
    assert application.view("picture").photo.isVisible()
    close.trigger()
    assert application.window.windowTitle() == TITLE
    assert not application.view("picture").photo.isVisible()
    assert not close.isEnabled()
    user.open_photo(photo_file)
    user.choose("&Line by line")
    assert "its lines shown as columns" in application.view("picture").photo.caption.toolTip()
    assert application.view("photo").facts.scan_axis.key() == "lines"
    user.choose("&Blended over")
    assert application.view("picture").opacity.isVisible()
    assert not application.view("picture").photo.isVisible()


def test_a_full_disk_while_saving_keeps_the_old_file_and_is_reported(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "scene.toml"
    application.files.save_scene(path)
    old = path.read_bytes()
    user.enter("distance", "2 m")
    assert application.window.isWindowModified()
    write = Path.write_bytes

    def fail_to_write(place: Path, content: bytes) -> int:
        write(place, content[:9])
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_bytes", fail_to_write)
        application.window.actions_by_name["save_scene"].trigger()
        assert "No space left on device" in user.message
    assert path.read_bytes() == old
    assert list(tmp_path.iterdir()) == [path]
    assert application.window.isWindowModified()
    application.window.actions_by_name["save_scene"].trigger()
    assert not application.window.isWindowModified()
    assert path.read_bytes() != old


def test_exported_figures_show_the_scene_just_chosen(
    application: Application, user: User, tmp_path: Path
) -> None:
    application.scene_store.change(distance=1.3)
    application.shell.pane("export").export("profile", tmp_path / "profile.csv")
    user.wait_until_idle()
    assert scene_inside(tmp_path / "profile.csv") == application.scene_store.scene
