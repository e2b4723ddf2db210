"""Short films of a small scene, in memory and in files, and sources of live pictures."""

from pathlib import Path

import numpy as np
import pytest
from films import write_film

import occ_model as occ
from occ_gui.video.camera import LivePicture
from occ_model.results.video import Video
from occ_model.scene.scene import Scene


class ListedSource:
    """Gives listed pictures as fast as they are asked for, and notes whether it is open."""

    title, axis = "Listed", "columns"

    def __init__(self, pictures: list[np.ndarray]) -> None:
        self.left = list(pictures)
        self.is_open = False
        self.locked: list[bool] = []
        self.knows_exposure = True

    def open(self) -> None:
        self.is_open = True

    def read(self) -> LivePicture | None:
        if not self.left:
            return None
        return LivePicture(0.1 * len(self.left), self.left.pop(0))

    def lock_exposure(self, on: bool) -> bool:
        self.locked.append(on)
        return self.knows_exposure

    def close(self) -> None:
        self.is_open = False


@pytest.fixture
def film_scene() -> Scene:
    """Return a scene whose frames are small, and whose code each of them shows."""
    scene = occ.load_preset("phone-68us")
    return scene.replace(rows=60, columns=1600, readout_time=15e-6, distance=0.8)


@pytest.fixture
def film(film_scene: Scene) -> Video:
    return occ.render_video(film_scene, 6, occ.Recording(frame_rate=30.0))


@pytest.fixture
def film_file(film: Video, tmp_path: Path) -> Path:
    path = tmp_path / "stripes.avi"
    write_film(path, "MJPG", (frame.image for frame in film), size=film.shape)
    return path
