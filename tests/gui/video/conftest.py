"""Short films of a small scene, in memory and in files."""

from pathlib import Path

import pytest
from films import write_film

import occ_model as occ
from occ_model.results.video import Video
from occ_model.scene.scene import Scene


@pytest.fixture
def film_scene() -> Scene:
    """Return a scene with small frames, each of which shows the whole code."""
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
