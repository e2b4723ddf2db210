"""What is written shows the scene of the controls: it waits for it, or is given up."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from gui.user import User
from PySide6.QtGui import QGuiApplication

import occ_model as occ
from occ_gui.app.application import Application
from occ_gui.simulation.snapshot import Snapshot
from occ_model.scene.provenance import scene_inside


def test_results_of_the_present_scene_are_given_at_once(application: Application) -> None:
    given: list[Snapshot] = []
    application.present.ask(given.append)
    (snapshot,) = given
    assert snapshot.request.scene == application.store.scene


def test_results_of_an_earlier_scene_are_never_given(application: Application, user: User) -> None:
    given: list[Snapshot] = []
    for distance in (0.9, 1.0, 1.1):
        application.store.change(distance=distance)
        application.present.ask(given.append)
    assert given == []
    assert user.message == "Waiting for the picture of this scene…"
    user.wait_until_idle()
    assert [snapshot.request.scene.pose.distance for snapshot in given] == [1.1] * 3


def test_a_saved_picture_is_of_the_scene_just_chosen(
    application: Application, user: User, tmp_path: Path
) -> None:
    path = tmp_path / "picture.png"
    application.store.change(code=0b1100110011)
    application.files.save_picture(path)
    user.wait_until_idle()
    assert user.message == "Saved picture.png: the camera's picture"
    settings = application.settings.settings
    expected = occ.render(application.store.scene, noise=settings.noise).camera_image
    written = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    assert written is not None
    assert np.array_equal(written, expected)


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


def test_of_a_scene_without_a_picture_nothing_is_written(
    application: Application, user: User, tmp_path: Path
) -> None:
    path, given = tmp_path / "picture.png", list[Snapshot]()
    application.store.change(yaw=1.5, panel_width=50.0)  # behind the camera
    application.files.save_picture(path)
    user.wait_until_idle()
    application.present.ask(given.append)
    refused = "This scene has no picture: nothing has been written or copied."
    assert user.message == refused
    application.shell.pane("export").copy("picture")
    assert user.message == refused
    assert not path.exists()
    application.store.change(yaw=0.0, panel_width=0.6)
    user.wait_until_idle()
    assert (path.exists(), given) == (False, [])
    application.present.ask(given.append)
    assert len(given) == 1
