"""Files are written from the results of the present scene, wait for them, or are cancelled."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from gui.simulation.conftest import SimulationBench

import occ_model as occ
from occ_gui.files.file_controller import FileController
from occ_gui.files.preferences import Preferences
from occ_gui.photo.photo_controller import PhotoController
from occ_gui.shell.results import ResultsStore
from occ_gui.simulation.present_results import PresentResults
from occ_gui.simulation.snapshot import Snapshot


@pytest.fixture
def messages() -> list[str]:
    return []


@pytest.fixture
def present(bench: SimulationBench, messages: list[str]) -> PresentResults:
    """Return present results after the first picture."""
    present = PresentResults(bench.controller)
    present.status_message.connect(messages.append)
    bench.change(iso=150.0)
    return present


def test_results_of_an_earlier_scene_are_never_delivered(
    bench: SimulationBench, present: PresentResults, messages: list[str]
) -> None:
    snapshots: list[Snapshot] = []
    for distance in (0.9, 1.0, 1.1):
        bench.store.change(distance=distance)
        present.ask(snapshots.append)
    assert snapshots == []
    assert messages[-1] == "Waiting for the picture of this scene…"
    bench.wait_until_idle()
    assert [snapshot.request.scene.pose.distance for snapshot in snapshots] == [1.1] * 3


def test_a_picture_is_saved_of_the_scene_just_chosen_or_not_at_all(
    bench: SimulationBench, present: PresentResults, messages: list[str], tmp_path: Path
) -> None:
    path, store = tmp_path / "picture.png", bench.store
    photos = PhotoController(store.store, ResultsStore())
    files = FileController(None, store, photos, Preferences(), present.ask)
    files.status_message.connect(messages.append)
    store.change(yaw=1.5, panel_width=50.0)  # behind the camera
    files.save_picture(path)
    bench.wait_until_idle()
    refusal = "This scene has no picture: nothing has been written or copied."
    assert messages[-1] == refusal
    snapshots = list[Snapshot]()
    present.ask(snapshots.append)
    assert messages.count(refusal) == 2
    store.change(yaw=0.0, panel_width=0.6, code=0b1100110011)
    assert (path.exists(), snapshots) == (False, [])
    files.save_picture(path)
    bench.wait_until_idle()
    assert snapshots == []
    assert messages[-1] == "Saved picture.png: the camera's picture"
    image = occ.render(store.scene).camera_image
    assert np.array_equal(cv2.imread(str(path), cv2.IMREAD_UNCHANGED), image)
    present.ask(snapshots.append)
    assert len(snapshots) == 1
