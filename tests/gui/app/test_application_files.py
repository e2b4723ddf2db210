"""Photos, pictures and scenes: opened by the menu, shown in the panes, saved to files."""

from pathlib import Path

import numpy as np
import pytest
from gui.user import User
from PySide6.QtGui import QGuiApplication

import occ_model as occ
from occ_gui.app.application import Application
from occ_model.scene.provenance import scene_inside

TITLE = "Optical Camera Communication"


def test_an_open_photo_stands_in_the_title_until_it_is_closed(
    application: Application, user: User, photo_file: Path
) -> None:
    close = user.entry("&Close photo")
    assert application.window.windowTitle() == TITLE
    assert not close.isEnabled()
    application.open_photo(photo_file)
    user.wait_until_idle()
    assert application.window.windowTitle() == f"stripes.png – {TITLE}"  # noqa: RUF001
    assert application.view("picture").photo.isVisible()
    close.trigger()
    assert application.window.windowTitle() == TITLE
    assert not application.view("picture").photo.isVisible()
    assert not close.isEnabled()


def test_the_menu_turns_the_photo_and_overlays_the_simulation(
    application: Application, user: User, photo_file: Path
) -> None:
    application.open_photo(photo_file)
    user.wait_until_idle()
    user.choose("&Line by line")
    assert "its lines shown as columns" in application.view("picture").photo.caption.toolTip()
    assert application.view("photo").facts.scan_axis.key() == "lines"
    user.choose("&Blended over")
    assert application.view("picture").opacity.isVisible()
    assert not application.view("picture").photo.isVisible()


def test_the_photos_profile_is_drawn_beside_the_simulations(
    application: Application, user: User, photo_file: Path
) -> None:
    assert not application.view("profile").residual.isVisible()
    application.open_photo(photo_file)
    user.wait_until_idle()
    columns, levels = application.view("profile").photo.getOriginalDataset()
    _, residual = application.view("profile").residual.curve.getOriginalDataset()
    profile = application.view("profile").simulation.getOriginalDataset()[1]
    assert np.allclose(levels - profile[columns.astype(int)], residual)
    assert "correlation" in application.view("profile").residual.numbers.toolTip()


def test_the_picture_on_the_screen_is_the_one_that_is_saved(
    application: Application, user: User, tmp_path: Path
) -> None:
    user.enter("iso", "321")
    application.files.save_picture(tmp_path / "picture.png")
    saved = occ.load_photo(tmp_path / "picture.png", "columns").image
    shown = occ.render(application.store.scene, noise="reused").camera_image
    assert np.array_equal(saved, shown)
    assert user.message == "Saved picture.png: the camera's picture"


def test_a_saved_scene_is_opened_again_with_its_controls(
    application: Application, user: User, tmp_path: Path
) -> None:
    user.enter("distance", "2 m")
    application.files.save_scene(tmp_path / "scene.toml")
    user.enter("distance", "3 m")
    application.files.open_scene(tmp_path / "scene.toml")
    user.wait_until_idle()
    assert user.row("distance").field.value() == 2.0


def test_a_full_disk_while_saving_keeps_the_old_file_and_says_so(
    application: Application, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "scene.toml"
    application.files.save_scene(path)
    old = path.read_bytes()
    user.enter("distance", "2 m")
    assert application.window.isWindowModified()
    write = Path.write_bytes

    def full(place: Path, content: bytes) -> int:
        write(place, content[:9])
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_bytes", full)
        application.window.actions_by_name["save_scene"].trigger()
        assert "No space left on device" in user.message
    assert path.read_bytes() == old
    assert list(tmp_path.iterdir()) == [path]
    assert application.window.isWindowModified()
    application.window.actions_by_name["save_scene"].trigger()
    assert not application.window.isWindowModified()
    assert path.read_bytes() != old


@pytest.mark.parametrize(
    "where", ["file", pytest.param("folder", marks=pytest.mark.whole), "clipboard"]
)
def test_an_exported_figure_is_of_the_scene_just_chosen(
    application: Application, user: User, tmp_path: Path, where: str
) -> None:
    export, path = application.shell.pane("export"), tmp_path / "profile.png"
    application.store.change(distance=1.3)
    if where == "file":
        export.export("profile", path)
    elif where == "folder":
        export.export_all(tmp_path)
    else:
        export.copy("profile")
    user.wait_until_idle()
    if where == "clipboard":
        QGuiApplication.clipboard().image().save(str(path))
    assert scene_inside(path) == application.store.scene
