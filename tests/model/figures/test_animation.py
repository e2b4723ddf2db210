"""An animation has a frame for each value, opens in other programs, and is written completely."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from amount import amount
from PIL import Image

import occ_model as occ
from occ_model.cli import main
from occ_model.figures import animation
from occ_model.figures.animation import ENDINGS, write_animation
from occ_model.scene.parameters import quantity
from occ_model.scene.provenance import scene_inside
from occ_model.scene.scene import Scene

pytestmark = pytest.mark.usefixtures("plain_figures")

VALUES = [4e3, 8e3]


@pytest.fixture(scope="module")
def scene() -> Scene:
    return occ.load_preset("phone-136us").replace(rows=150, columns=700)


@pytest.mark.parametrize("ending", ENDINGS)
def test_there_is_a_frame_for_each_value(tmp_path: Path, scene: Scene, ending: str) -> None:
    path, done = tmp_path / f"a{ending}", list[int]()
    write_animation(path, scene, "switching_frequency", VALUES, progress=done.append)
    assert done == [1, 2]
    if ending == ".mp4":
        film = cv2.VideoCapture(str(path))
        frames = [film.read() for _ in range(3)]
        film.release()
        assert [read for read, _ in frames] == [True, True, False]
        image = frames[0][1]
        assert np.ptp(image) > 200
        dark_rows = np.mean(image[:, 200:800] < 128, axis=(1, 2)) > 0.9  # the picture's columns
        assert 100 < np.count_nonzero(dark_rows) < 200
    else:
        with Image.open(path) as pictures:
            assert getattr(pictures, "n_frames", 1) == 2
    if ending == ".png":
        assert scene_inside(path) == scene
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"name": "code"}, "code cannot change in an animation"),
        ({"name": "speed"}, "speed"),
        ({"name": "duty"}, "duty cannot change in an animation: it is of the light lamp, not of c"),
        ({"values": []}, "frames is 0; allowed: 1 to 300"),
        ({"values": [1e3] * 301}, "frames is 301"),
        ({"values": [-1.0]}, "switching_frequency is -1 Hz"),
        ({"rate": 0.0}, "rate is 0.0 a second"),
        ({"path": Path("a.avi")}, "use .gif, .mp4 or .png"),
        ({"path": Path("/none/a.gif")}, "/none"),
    ],
)
def test_animations_that_are_impossible_are_refused(
    tmp_path: Path, scene: Scene, changes: dict[str, object], words: str
) -> None:
    wanted = {"name": "switching_frequency", "values": VALUES, "path": tmp_path / "a.gif"} | changes
    name, values, path = wanted.pop("name"), wanted.pop("values"), wanted.pop("path")
    done: list[int] = []
    with pytest.raises(occ.OccError, match=words):
        write_animation(path, scene, name, values, progress=done.append, **wanted)  # type: ignore[arg-type]
    assert done == []  # refused before the work, not after it
    assert list(tmp_path.iterdir()) == []


def test_an_animation_that_is_ended_leaves_no_file(tmp_path: Path, scene: Scene) -> None:
    def end(_done: int) -> None:
        raise KeyboardInterrupt

    for ending in ENDINGS[-amount(1, 3) :]:
        with pytest.raises(KeyboardInterrupt):
            write_animation(tmp_path / f"a{ending}", scene, "iso", [100.0, 200.0], progress=end)
    assert list(tmp_path.iterdir()) == []


def test_the_command_runs_there_and_back(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[object] = []
    monkeypatch.setattr(
        animation, "write_animation", lambda _path, _scene, *axis, **_: asked.extend(axis)
    )
    axis = ["--vary", "switching_frequency=4kHz:16kHz:x3", "--back"]
    assert main(["animate", *axis, "-o", "a.gif"]) == 0
    assert asked == ["switching_frequency", [4e3, 8e3, 16e3, 8e3]]


def test_the_legend_says_where_the_band_model_is_undefined(scene: Scene) -> None:
    drawing = animation.AnimatedFigure(quantity("switching_frequency"), 200.0)
    names = []
    for frequency in (8e3, 4e3):
        drawing.draw(occ.render(scene.replace(switching_frequency=frequency)), "threshold")
        names.append(drawing.band_name.get_text())
    assert names == ["band model (undefined here)", "band model"]


def test_a_lamp_s_duty_moves_and_its_frames_state_what_is_sent(
    tmp_path: Path, scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[tuple[float, str]] = []

    def draw(_self: object, frame: occ.Frame, read: str) -> np.ndarray:
        drawn.append((float(frame.profile.mean()), read))
        return np.zeros((4, 4, 3), np.uint8)

    monkeypatch.setattr(animation.AnimatedFigure, "draw", draw)
    lamp = scene.replace(light="lamp", lamp_frequency=2e3)
    write_animation(tmp_path / "a.gif", lamp, "duty", [0.1, 0.5, 0.9])
    levels, read = zip(*drawn, strict=True)
    assert read == tuple(f"lamp of 2 kHz, duty {percent} %" for percent in (10, 50, 90))
    assert np.diff(levels).min() > 20.0
