"""What is written shows the scene of the controls: it waits for it, or is given up."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from gui.kinds import not_none
from gui.simulation.conftest import Bench

import occ_model as occ
from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.shell.results import ResultsStore
from occ_gui.simulation.present_results import PresentResults
from occ_gui.simulation.snapshot import Snapshot


@pytest.fixture
def said() -> list[str]:
    return []


@pytest.fixture
def present(bench: Bench, said: list[str]) -> PresentResults:
    """Return results of the present scene, the first of which are there."""
    present = PresentResults(bench.controller)
    present.status_message.connect(said.append)
    bench.store.change(iso=150.0)
    bench.wait_until_idle()
    return present


def test_results_of_the_present_scene_are_given_at_once(
    bench: Bench, present: PresentResults
) -> None:
    given: list[Snapshot] = []
    present.ask(given.append)
    (snapshot,) = given
    assert snapshot.request.scene == bench.store.scene


def test_results_of_an_earlier_scene_are_never_given(
    bench: Bench, present: PresentResults, said: list[str]
) -> None:
    given: list[Snapshot] = []
    for distance in (0.9, 1.0, 1.1):
        bench.store.change(distance=distance)
        present.ask(given.append)
    assert given == []
    assert said[-1] == "Waiting for the picture of this scene…"
    bench.wait_until_idle()
    assert [snapshot.request.scene.pose.distance for snapshot in given] == [1.1] * 3


def test_a_picture_is_saved_of_the_scene_just_chosen_or_not_at_all(
    bench: Bench, present: PresentResults, said: list[str], tmp_path: Path
) -> None:
    path, store = tmp_path / "picture.png", bench.store
    photos = PhotoController(store.store, ResultsStore())
    files = FileController(None, store, photos, Preferences(), present.ask)  # type: ignore[arg-type]
    files.status_message.connect(said.append)
    store.change(yaw=1.5, panel_width=50.0)  # behind the camera
    files.save_picture(path)
    bench.wait_until_idle()
    refused = "This scene has no picture: nothing has been written or copied."
    assert said[-1] == refused
    given = list[Snapshot]()
    present.ask(given.append)
    assert said.count(refused) == 2
    store.change(yaw=0.0, panel_width=0.6, code=0b1100110011)
    assert (path.exists(), given) == (False, [])
    files.save_picture(path)
    bench.wait_until_idle()
    assert given == []
    assert said[-1] == "Saved picture.png: the camera's picture"
    expected = occ.render(store.scene, noise=bench.settings.settings.noise).camera_image
    written = not_none(cv2.imread(str(path), cv2.IMREAD_UNCHANGED))
    assert np.array_equal(written, expected)
    present.ask(given.append)
    assert len(given) == 1
